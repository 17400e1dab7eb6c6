"""Options that are more than a word: sizes, frame ranges, colours, marks."""

from __future__ import annotations

import re
from argparse import ArgumentTypeError


def size(text: str) -> tuple[int, int]:
    """Read ``960x540``."""
    from core.io.exporters import LONGEST_SIDE

    found = re.fullmatch(r"(\d{1,6})[x×](\d{1,6})", text, re.IGNORECASE)
    pixels = (int(found[1]), int(found[2])) if found else (0, 0)
    if not all(1 <= side <= LONGEST_SIDE for side in pixels):
        raise ArgumentTypeError(
            f"{text!r} is not a size; write WIDTHxHEIGHT, each 1 to {LONGEST_SIDE}, as in 960x540"
        )
    return pixels


def frames(text: str) -> tuple[int, int]:
    """Read ``1-24``, or a single frame."""
    found = re.fullmatch(r"(-?\d{1,7})(?:-(-?\d{1,7}))?", text)
    if not found:
        raise ArgumentTypeError(f"{text!r} is no range of frames; write FIRST-LAST, as in 1-24")
    first, last = int(found[1]), int(found[2] or found[1])
    if last < first:
        raise ArgumentTypeError(f"frame {last} comes before frame {first}")
    return first, last


def background(text: str) -> str:
    """Read a colour of the model; "none" is transparent."""
    names = {"none": "", "white": "#ffffff", "black": "#000000"}
    colour = names.get(text.lower(), text)
    if text.lower() not in names and not re.fullmatch(
        r"#([0-9a-f]{6}|[0-9a-f]{8})", colour, re.IGNORECASE
    ):
        raise ArgumentTypeError(
            f"{text!r} is not a colour; write #rrggbb, #rrggbbaa, white, black or none"
        )
    return colour


def frame_rate(text: str) -> float:
    """Read how many frames a second there are."""
    from core.model.structure import LEAST_RATE, MOST_RATE

    try:
        rate = float(text)
    except ValueError:
        rate = 0.0
    if not LEAST_RATE <= rate <= MOST_RATE:
        raise ArgumentTypeError(
            f"{text!r} is no frame rate; it lies between {LEAST_RATE} and {MOST_RATE}"
        )
    return rate


def length(text: str) -> int:
    """Read a number of frames that leaves room for two keyframes."""
    if not re.fullmatch(r"\d{1,6}", text) or int(text) < 2:
        raise ArgumentTypeError(f"{text!r} is no length in frames; it is 2 or more")
    return int(text)


def marks(text: str) -> list[tuple[int, int]] | None:
    """Read ``0:0,12:9``; None stands for ``auto``."""
    if text.strip().lower() == "auto":
        return None
    pairs = [re.fullmatch(r"\s*(\d{1,7})\s*:\s*(\d{1,7})\s*", pair) for pair in text.split(",")]
    if not all(pairs):
        raise ArgumentTypeError(
            f"{text!r} are no marks; write pairs of node numbers, as in 0:0,12:9, or auto"
        )
    return [(int(pair[1]), int(pair[2])) for pair in pairs if pair]
