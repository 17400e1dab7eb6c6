"""Shapes with holes into one another, made by formula."""

from __future__ import annotations

import numpy as np

from core.model import Outline
from tests.benchmarks.pairs import Pair, Rings
from tests.core.shapes import ellipse, letter_l, limb, rotation, square_ring


def hole_pairs() -> list[Pair]:
    """Return the pairs: holes that turn, wander, grow, and lie close to the boundary or others."""
    washer = [ellipse(60, 2, 2), ellipse(40, 0.9, 0.9)]
    pairs = {
        "washer → frame": (washer, square_ring()),
        "frame → turned": (square_ring(), turned(square_ring(), 1.2)),
        "washer → gear": (washer, [gear(9, 2.0, 0.4), ellipse(40, 0.6, 0.6)]),
        "button → turned": (button(4), turned(button(4), 0.6)),
        "button → face": (button(3), face()),
        "belt → wide belt": (belt(0.12), belt(0.8)),
        "limb with a slot → bent": (slotted(0.0), slotted(2.0)),
        "letter with a hole → moved": (pierced((0.5, 0.5)), pierced((0.5, 4.4))),
    }
    return [
        Pair(name, Outline.polygon(*source), Outline.polygon(*target))
        for name, (source, target) in pairs.items()
    ]


def turned(rings: Rings, angle: float) -> Rings:
    """Return the rings turned about the origin."""
    return [ring @ rotation(angle).T for ring in rings]


def gear(teeth: int, radius: float, depth: float) -> np.ndarray:
    """Return a ring with rounded teeth."""
    angle = 2 * np.pi * np.arange(12 * teeth) / (12 * teeth)
    wave = radius + depth * np.tanh(3 * np.sin(teeth * angle))
    return wave[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def button(count: int) -> Rings:
    """Return a disc with holes around its centre."""
    angles = 2 * np.pi * np.arange(count) / count
    centres = 0.9 * np.column_stack([np.cos(angles), np.sin(angles)])
    return [ellipse(60, 2, 2), *(ellipse(24, 0.35, 0.35) + centre for centre in centres)]


def face() -> Rings:
    """Return a head with two eyes and a mouth."""
    eyes = [ellipse(24, 0.2, 0.35) + np.array([x, 0.6]) for x in (-0.7, 0.7)]
    mouth = limb(1.6, 12, 1.8, 0.25) @ rotation(-0.8).T + [-0.85, -0.6]
    return [ellipse(60, 1.8, 2.2), *eyes, mouth]


def belt(width: float) -> Rings:
    """Return a long ring of even width."""
    return [ellipse(80, 3, 1.5), ellipse(80, 3 - width, 1.5 - width)]


def slotted(bend: float) -> Rings:
    """Return a bent bar with a slot along its middle."""
    slot = limb(bend, 32, 6, 0.4)[[*range(6, 26), *range(38, 58)]]
    return [limb(bend, 32, 6, 1.2), slot]


def pierced(centre: tuple[float, float]) -> Rings:
    """Return an L with a round hole."""
    return [letter_l(), ellipse(24, 0.3, 0.3) + centre]
