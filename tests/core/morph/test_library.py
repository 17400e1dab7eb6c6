"""``core.solve`` as a script uses it."""

from itertools import pairwise

import numpy as np
import pytest

import core
from core.fem.elements import Elements
from core.geometry.crossing import crosses_itself
from core.model import Outline, Recipe, RingPoint
from core.morph.pipeline import solve_outlines
from tests.core.shapes import comb, ellipse, letter_l, limb, rotation, square_ring


def test_the_documented_attributes_have_the_documented_shapes():
    morph = core.solve(ellipse(), letter_l())
    n, m = len(morph.rest), len(morph.triangles)
    assert morph.triangles.shape == (m, 3)
    assert morph.rest.shape == morph.target.shape == morph.at(0.3).shape == (n, 2)
    assert len(morph.rings) == 1
    assert not crosses_itself([morph.at(0.5)[morph.rings[0]]])
    report = morph.report
    assert (report.vertices, report.triangles) == (n, m)
    assert report.folds_source == report.folds_target == ()
    assert report.distortion_worst >= report.distortion_mean >= 1
    stages = [stage.name for stage in report.stages]
    assert stages == [
        "outlines",
        "matching",
        "sliding",
        "mesh",
        "placement",
        "angles",
        "in-between",
    ]
    last = report.stages[5]
    assert (last.folds, last.distortion) == (0, pytest.approx(report.distortion_mean))
    assert report.seconds == pytest.approx(sum(stage.seconds for stage in report.stages))


def test_holes_map_to_holes_with_marks_on_them():
    source = square_ring()
    target = [ring @ rotation(0.5).T for ring in source]
    morph = core.solve(source, target, [(0, 0), ((1, 0), (1, 0))])
    assert len(morph.rings) == 2
    assert morph.report.folds_target == ()
    area = Elements.of(morph.at(0.5), morph.triangles).areas.sum()
    assert area == pytest.approx(12, rel=1e-6)


def test_holes_without_marks_follow_the_exterior():
    source = square_ring()
    target = [ring @ rotation(0.5).T for ring in source]
    morph = core.solve(source, target, [(0, 0)])
    assert morph.report.distortion_mean == pytest.approx(1, abs=1e-6)


def test_unequal_numbers_of_holes_are_refused():
    with pytest.raises(core.SolveError, match="The source has 1 hole, the target none"):
        core.solve(square_ring(), ellipse())


@pytest.mark.parametrize(
    ("source", "target", "hint"),
    [
        (1, 0, "Add a hole to the target, or remove hole 1 of the source."),
        (1, 2, "Add a hole to the source, or remove hole 2 of the target."),
        (3, 1, "Add 2 holes to the target, or remove holes 2 and 3 of the source."),
        (0, 3, "Add 3 holes to the source, or remove holes 1 to 3 of the target."),
    ],
)
def test_holes_without_partners_are_named_as_many_as_there_are(source, target, hint):
    sheet = np.array([[0, 0], [8, 0], [8, 2], [0, 2]], dtype=float)
    holes = [np.array([[0, 0], [0, 1], [1, 1]]) / 2 + [2 * k + 0.5, 0.5] for k in range(3)]
    with pytest.raises(core.SolveError) as caught:
        core.solve([sheet, *holes[:source]], [sheet, *holes[:target]])
    assert caught.value.hint == hint


@pytest.mark.parametrize(
    "recipe",
    [
        {"density": 0},
        {"density": 10**9},
        {"density": 12.5},
        {"mu": 0.0},
        {"lam": -1.0},
        {"mu": np.nan},
        {"mu": "soft"},
        {"method": "magic"},
        {"material": "jelly"},
    ],
)
def test_a_recipe_that_makes_no_sense_is_refused(recipe):
    with pytest.raises(core.SolveError, match=r"density|elastic|no method|no material"):
        core.solve(ellipse(), letter_l(), recipe=core.Recipe(**recipe))


def test_what_is_no_recipe_is_refused():
    with pytest.raises(core.SolveError, match="not a Recipe"):
        core.solve(ellipse(), letter_l(), recipe={"density": 20})


@pytest.mark.parametrize("points", [ellipse() * 1j, [[0, 0], [1], [1, 1]], np.zeros((4, 3)), 5])
def test_points_that_are_no_pairs_of_numbers_are_refused(points):
    with pytest.raises(core.OutlineError, match="The target is not an") as caught:
        core.solve(ellipse(), points)
    assert ".." not in str(caught.value)


def test_errors_call_marks_by_their_indices():
    with pytest.raises(core.MarkError, match="Marks 0 and 2 lie on the same point"):
        core.solve(ellipse(), letter_l(), [(4, 0), (9, 3), (4, 1)])


def test_frames_cannot_be_written_to():
    morph = core.solve(ellipse(), letter_l())
    assert not any(morph.at(s).flags.writeable for s in (0, 0.5, 1))


@pytest.mark.parametrize("nothing", [core.Outline(()), core.Outline.polygon([]), [[], []]])
def test_an_outline_without_points_is_refused(nothing):
    with pytest.raises(core.OutlineError, match="target"):
        core.solve(ellipse(), nothing)


def test_a_mark_that_names_no_vertex_is_refused():
    with pytest.raises(core.MarkError, match="vertex 99 of ring 0 of the target"):
        core.solve(ellipse(), letter_l(), [(0, 99)])


@pytest.mark.parametrize("marks", [np.array([[0, 0], [9, 3]]), [[0, 0], [9, 3]], [(0, 0), (9, 3)]])
def test_marks_may_be_any_pairs_of_integers(marks):
    morph = core.solve(ellipse(), letter_l(), marks)
    source = [tuple(p) for p in morph.rest]
    for a, b in marks:
        assert tuple(morph.target[source.index(tuple(ellipse()[a]))]) == tuple(letter_l()[b])


@pytest.mark.parametrize("mark", [3, (0, 1, 2), (0.5, 1), ("a", 1), ((0, 1, 2), 0), None])
def test_a_mark_that_is_no_pair_of_vertices_is_refused(mark):
    with pytest.raises(core.MarkError, match="Mark 1"):
        core.solve(ellipse(), letter_l(), [(0, 0), mark])


@pytest.mark.parametrize("nonsense", ["text", [1, 2, 3], [[1, 2], [3]], None, np.zeros((4, 3))])
def test_what_is_no_outline_is_refused_with_its_side(nonsense):
    with pytest.raises(core.OutlineError, match="target"):
        core.solve(ellipse(), nonsense)


def test_progress_rises_from_nought_and_names_the_stages():
    seen = []
    core.solve(limb(0.0), limb(5.0), progress=lambda f, stage: seen.append((f, stage)))
    fractions = [f for f, _ in seen]
    assert all(before < after for before, after in pairwise(fractions))
    assert fractions[0] >= 0
    assert fractions[-1] <= 1
    assert {"outlines", "matching", "mesh", "in-between"} <= {stage for _, stage in seen}


def test_progress_can_stop_the_work_at_every_point():
    total = []
    core.solve(limb(0.0), limb(5.0), progress=lambda f, stage: total.append(f))
    for stop in range(len(total)):
        calls = []

        def progress(fraction, stage, calls=calls, stop=stop):
            calls.append(fraction)
            if len(calls) > stop:
                raise core.Cancelled

        with pytest.raises(core.Cancelled):
            core.solve(limb(0.0), limb(5.0), progress=progress)


def test_the_history_of_energy_and_folds_is_kept():
    report = core.solve(limb(0.0), limb(5.5)).report
    assert {i.stage for i in report.iterations} == {"untangle", "symmetric-dirichlet"}
    assert report.iterations[-1].folds == 0
    assert all(np.isfinite(i.energy) for i in report.iterations)


def test_repairs_are_reported():
    (repair,) = core.solve(np.repeat(ellipse(), 2, axis=0), letter_l()).report.repairs
    assert str(repair) == "The source outline has 40 repeated points: left out."


def test_a_mark_that_has_moved_leaves_no_trace_of_where_it_was():
    def solved(ends, at):
        marks = [(RingPoint(0, 3.0), RingPoint(0, at)), (RingPoint(0, 20.0), RingPoint(0, 20.0))]
        return solve_outlines(*ends, marks, recipe=Recipe(density=40))

    ends, fresh = ([Outline.polygon(limb(bend)) for bend in (0.0, 1.2)] for _ in "ab")
    solved(ends, 3.0)
    moved, anew = solved(ends, 3.6), solved(fresh, 3.6)
    for t in (0.0, 0.4, 1.0):
        assert np.array_equal(moved.at(t), anew.at(t))


@pytest.mark.parametrize(("name", "number"), [("beetle", 4), ("lizard", 2)])
def test_coarse_maps_of_shapes_with_narrow_corners_keep_every_drawn_vertex(
    shared_data, name, number
):
    shapes = np.load(shared_data / "mpeg7_outlines.npz")
    ends = [shapes[f"{name}-{number + k:02d}"].astype(float) for k in (0, 1)]
    morph = core.solve(*ends, recipe=Recipe(density=40))
    for drawn, found in zip(ends, (morph.rest, morph.target), strict=True):
        assert {tuple(p) for p in drawn} <= {tuple(p) for p in found}


def test_a_comb_against_a_square_keeps_both_outlines():
    square = np.array([[0, 0], [9, 0], [9, 4], [0, 4]], dtype=float)
    morph = core.solve(comb(), square, [(0, 0), (1, 1)])
    for drawn, end in ((comb(), morph.rest), (square, morph.target)):
        assert {tuple(p) for p in drawn} <= {tuple(p) for p in end}


def test_without_marks_a_shape_is_not_turned_for_nothing():
    bar = np.array([[0, 0], [8, 0.1], [8, 1.1], [4, 1.25], [0, 1]])
    morph = core.solve(bar, bar * [1.1, 1.0] + [0.0, 3.0])
    assert abs(morph.angle) < 0.2


def test_without_marks_a_shape_that_did_turn_is_turned():
    morph = core.solve(letter_l(), letter_l() @ rotation(2.8).T)
    assert morph.angle == pytest.approx(2.8, abs=0.01)


def test_a_mirrored_shape_is_said_to_match_better_mirrored_and_others_are_not():
    flag = np.array([[0, 0], [1, 0], [5, 1], [5, 3], [1, 2.5], [1, 8], [0, 8]])
    assert core.solve(flag, flag * [-1, 1]).report.mirror
    assert not core.solve(flag, flag @ rotation(1.0).T).report.mirror
    assert not core.solve(comb(), ellipse()).report.mirror


def test_the_marks_that_were_used_are_reported_and_accepting_them_changes_nothing():
    source = [np.array(ring) for ring in (4 * letter_l(), 0.5 * ellipse() + [2, 2])]
    source[0] = source[0][::-1]
    target = [ring @ rotation(0.5).T * [1.2, 1.0] for ring in source]
    ends = [core.Outline.polygon(*rings) for rings in (source, target)]
    free = core.solve(*ends)
    assert {(a.ring, b.ring) for a, b, _ in free.report.proposed} == {(0, 0), (1, 1)}
    assert all(0 <= confidence <= 1 for _, _, confidence in free.report.proposed)
    accepted = solve_outlines(*ends, [(a, b) for a, b, _ in free.report.proposed])
    assert np.array_equal(accepted.triangles, free.triangles)
    assert np.allclose(accepted.target, free.target, atol=1e-9)
    assert accepted.report.proposed == ()


def test_marks_of_the_artist_are_not_reported_as_proposals():
    rings = [np.array(ring) for ring in square_ring()]
    proposed = core.solve(rings, rings, [(0, 0)]).report.proposed
    assert {(a.ring, b.ring) for a, b, _ in proposed} == {(1, 1)}


def test_marks_that_are_no_list_are_refused():
    with pytest.raises(core.MarkError, match="not a list of pairs"):
        core.solve(ellipse(), letter_l(), 5)
