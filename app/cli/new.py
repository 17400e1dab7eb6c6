"""``betwixt new``: a project from two outlines."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli import values
from app.cli.terminal import OK, complain

if TYPE_CHECKING:
    from core.io.importers import Part
    from core.model import Document, Outline, RingPoint

SUMMARY = "make a project from two outlines"
DESCRIPTION = """\
Make a project that morphs SOURCE, at frame 1, into TARGET, at the last frame.

Either may be an SVG drawing (.svg) or a point list (.csv, .txt, .json). Of a file
with several parts, say which: drawing.svg#2, or by name, drawing.svg#wing. Without
a choice the parts are listed.

Marks pin a node of the source to a node of the target. Nodes count from 0 along
the exterior, and on along the holes.
"""
EXAMPLES = """\
examples:
  betwixt new standing.svg jumping.svg -o jump.betwixt
  betwixt new icons.svg#moon icons.svg#star --frames 48 --fps 25 -o night.betwixt
  betwixt new a.csv b.csv --marks 0:0,12:9,30:31 -o ab.betwixt
"""

ARTBOARD = (960, 540)
UNLIKE = 4
"""Shapes whose sizes differ by more than this are probably in different units."""


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument("source", metavar="SOURCE", help="FILE or FILE#PART to begin with")
    parser.add_argument("target", metavar="TARGET", help="FILE or FILE#PART to become")
    parser.add_argument(
        "-o", dest="file", type=Path, required=True, metavar="FILE", help="the project to write"
    )
    parser.add_argument(
        "--marks",
        type=values.marks,
        default=None,
        metavar="I:J,…",
        help="corresponding nodes, or auto, which finds the best fit (default auto)",
    )
    parser.add_argument(
        "--frames",
        type=values.length,
        default=24,
        metavar="N",
        help="length in frames (default 24)",
    )
    parser.add_argument(
        "--fps",
        type=values.frame_rate,
        default=24.0,
        metavar="N",
        help="frames a second (default 24)",
    )
    parser.add_argument(
        "--size",
        type=values.size,
        default=ARTBOARD,
        metavar="WxH",
        help="pixels of the artboard (default 960x540)",
    )
    parser.add_argument(
        "--fit",
        choices=("together", "each"),
        default="together",
        help="scale both shapes alike, so that one stays larger than the other, or each to fill"
        " the artboard (default together)",
    )

    parser.add_argument(
        "--mirror", action="store_true", help="mirror the target left to right first"
    )


def run(options: Namespace) -> int:
    """Read both outlines and write the project."""
    from core.io import project

    source, target = (_part(text) for text in (options.source, options.target))
    if options.mirror:
        target = replace(target, outline=target.outline.mirrored())
    document = _document(source, target, options)
    path = options.file
    if path.suffix != project.EXTENSION:
        path = path.with_name(path.name + project.EXTENSION)
    if not options.mirror and _better_mirrored(document):
        complain("Note: the target matches far better mirrored. Use --mirror to mirror it.")
    project.save(document, path)  # last, so that an interruption leaves nothing
    print(f"{path}: {source.name} becomes {target.name} in {options.frames} frames")
    return OK


def _better_mirrored(document: Document) -> bool:
    from core.errors import MorphError
    from core.morph.scene import solve_span, span_of

    with suppress(MorphError):  # what cannot be solved is told where it is to be shown
        return solve_span(span_of(document.layers[0], 0)).report.mirror
    return False


def _part(text: str) -> Part:
    """Read ``FILE`` or ``FILE#PART``, the part named after both.

    FileError lists the parts when the choice is open.
    """
    from core.errors import FileError, Where
    from core.io import importers

    path, choice = text, ""
    if "#" in text and not Path(text).exists():
        path, _, choice = text.rpartition("#")
    parts = importers.read(path, warn=lambda warning: complain(f"{path}: {warning}"))
    stem = Path(path).stem
    if not choice and len(parts) == 1:
        return replace(parts[0], name=stem)
    by_name = {part.name: part for part in parts}
    by_number = {str(i): part for i, part in enumerate(parts, 1)}
    chosen = by_name.get(choice) or by_number.get(choice)
    if chosen is None:
        problem = f"There is no part {choice!r}." if choice else f"There are {len(parts)} parts."
        listing = "\n".join(
            f"  {path}#{number:3} {_described(part)}" for number, part in by_number.items()
        )
        raise FileError(problem, where=Where(path=path), hint=f"Name one of them:\n{listing}")
    return replace(chosen, name=f"{stem} {chosen.name}")


def _described(part: Part) -> str:
    left, top, right, bottom = part.outline.bounds()
    colour = (part.style.fill or part.style.stroke) if part.style else ""
    holes = len(part.outline.rings) - 1
    extras = [colour] * bool(colour) + [f"{holes} hole{'s' * (holes > 1)}"] * bool(holes)
    return ", ".join([part.name, f"{right - left:.4g} × {bottom - top:.4g}", *extras])


def _document(source: Part, target: Part, options: Namespace) -> Document:
    from core.model import Document, Keyframe, Layer
    from core.model.layer import mark_labels

    width, height = options.size
    empty = Document(fps=options.fps, size=(float(width), float(height)))
    ends = _placed([source, target], empty.size, options.fit)
    outlines = [end.outline for end in ends]
    pairs = _marks(outlines, options.marks)
    labels = tuple(label for label, _ in zip(mark_labels(), pairs, strict=False))
    keyframes = tuple(
        Keyframe(frame, outline, tuple(pair[i] for pair in pairs))
        for i, (frame, outline) in enumerate(zip((1, options.frames), outlines, strict=True))
    )
    style = ends[0].style_on(empty.background)
    return replace(empty, layers=(Layer(1, source.name, keyframes, labels, style),))


def _placed(ends: list[Part], size: tuple[float, float], how: str) -> list[Part]:
    """Bring source and target onto the artboard; say so if one is lost beside the other."""
    from core.io.importers import bounds, fitted

    if how == "each":
        return [placed for end in ends for placed in fitted([end], size)]
    before, after = (_extent(bounds([end])) for end in ends)
    ratio = after / before
    if not 1 / UNLIKE < ratio < UNLIKE:
        complain(
            f"Note: the target is {max(ratio, 1 / ratio):.3g} times"
            f" {'larger' if ratio > 1 else 'smaller'} than the source."
            " Use --fit each to make them alike."
        )
    return fitted(ends, size)


def _extent(box: tuple[float, float, float, float]) -> float:
    left, top, right, bottom = box
    return max(right - left, bottom - top)


def _marks(
    outlines: list[Outline], pairs: list[tuple[int, int]] | None
) -> list[tuple[RingPoint, RingPoint]]:
    """Turn node numbers into places. Without any, the outlines' own features decide."""
    return [
        (_node(outlines[0], i, "source"), _node(outlines[1], j, "target")) for i, j in pairs or ()
    ]


def _node(outline: Outline, number: int, side: str) -> RingPoint:
    from core.errors import MarkError, Where
    from core.model import RingPoint

    left = number
    for ring, nodes in enumerate(map(len, outline.rings)):
        if left < nodes:
            return RingPoint(ring, float(left))
        left -= nodes
    raise MarkError(
        f"There is no node {number} on the {side}, which has {number - left} nodes.",
        where=Where(side=side),
        hint="Nodes count from 0.",
    )
