"""Whatever is drawn: a sound morph, or an error that says what, where and what to do."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import core
from core.errors import MarkError, MorphError, OutlineError, SolveError
from core.geometry.crossing import crosses_itself
from core.geometry.mending.mend import HAIRS
from core.model.outline import Array
from core.morph.morph import Morph
from core.morph.quality import folds
from tests.core.geometry.test_mend import TOUCHING
from tests.core.morph.polygons import comb, disc, hole, needle, spiral, star_shaped, untangled
from tests.core.shapes import letter_l, rotation

COARSE = core.Recipe(density=48)
FRAMES = 17
STEPS = 5000
"""More steps of work than any pair here takes: beyond, it would be a hang."""


@st.composite
def disturbed(draw: st.DrawFn, shape: Array) -> Array:
    """Draw a shape with vertices on its edges, vertices twice, and vertices next to themselves."""
    n = len(shape)
    corner = st.integers(0, n - 1)
    on_edges = draw(st.lists(st.tuples(corner, st.floats(0.01, 0.99)), max_size=6))
    beside = draw(st.lists(st.tuples(corner, st.sampled_from([0, 1e-15, 1e-12])), max_size=6))
    at = [*range(n), *(i + u for i, u in on_edges), *(i + 1e-3 for i, _ in beside)]
    along = [(1 - u) * shape[i] + u * shape[(i + 1) % n] for i, u in on_edges]
    points = [*shape, *along, *(shape[i] + trace for i, trace in beside)]
    return np.array(points)[np.argsort(at, kind="stable")]


@st.composite
def shapes(draw: st.DrawFn) -> Array:
    """Draw a simple polygon of any kind, from any vertex on, either way round."""
    shape = draw(
        st.one_of(
            st.integers(3, 40).flatmap(star_shaped),
            st.integers(12, 40).flatmap(untangled),
            st.builds(comb, st.integers(1, 6), st.integers(30, 90)),
            st.builds(spiral, st.floats(0.2, 1.5), st.integers(12, 60)),
            st.builds(needle, st.integers(4, 40), st.sampled_from([1e-1, 1e-2, 1e-3])),
            st.builds(disc, st.integers(3, 60)),
            st.builds(letter_l),
        )
    )
    shape = np.roll(draw(disturbed(shape)), draw(st.integers(0, 40)), axis=0)
    return shape[::-1] if draw(st.booleans()) else shape


@st.composite
def pairs(draw: st.DrawFn) -> tuple[Array, Array]:
    """Draw two shapes, at any size and anywhere, one up to a hundred times as large."""
    power = draw(st.floats(-6, 9))
    ends = []
    for _ in range(2):
        away = [draw(st.floats(-1e3, 1e3)) for _ in "xy"]
        turned = draw(shapes()) @ rotation(draw(st.floats(0, 6.3))).T
        ends.append((turned + away) * 10 ** (power + draw(st.floats(-1, 1))))
    return ends[0], ends[1]


def solved(source: object, target: object, marks: object = None) -> Morph:
    """Solve within a number of steps."""
    steps = 0

    def count(fraction: float, stage: str) -> None:
        nonlocal steps
        steps += 1
        assert steps < STEPS, f"{stage} does not end"
        assert 0 <= fraction <= 1

    return core.solve(source, target, marks, recipe=COARSE, progress=count)  # type: ignore[arg-type]


def assert_sound(morph: Morph, *ends: Sequence[Array], tolerance: float = 1e-9) -> None:
    """The map is one to one, no frame folds or crosses untold, and both ends are as drawn."""
    assert morph.report.certificate.holds
    for s in np.linspace(0, 1, FRAMES):
        points = morph.at(float(s))
        assert np.isfinite(points).all()
        assert len(folds(points, morph.triangles)) == 0
        crosses = crosses_itself([points[ring] for ring in morph.rings])
        assert not crosses or morph.inbetween.shape.limbs_pass
    repaired = {repair.where.side for repair in morph.report.repairs}
    for side, rings, points in zip(
        ("source", "target"), ends, (morph.rest, morph.target), strict=True
    ):
        away = tolerance * np.ptp(np.concatenate(rings))
        for ring in rings:
            assert any(
                drawn_on(ring, points[boundary], away, in_order=side not in repaired)
                for boundary in morph.rings
            )


def drawn_on(drawn: Array, ring: Array, away: float, *, in_order: bool) -> bool:
    """Whether each vertex drawn is one of a ring's, in order round it, either way."""
    distance = np.abs(drawn[:, None] - ring).max(axis=2)
    if distance.min(axis=1).max() > away:
        return False
    place = distance.argmin(axis=1)
    steps = np.diff(place, append=place[:1]) % len(ring)
    return not in_order or steps.sum() in (len(ring), (np.count_nonzero(steps) - 1) * len(ring))


@settings(max_examples=20)
@given(pairs())
def test_any_two_shapes_of_any_size_anywhere_give_a_sound_morph(pair):
    source, target = pair
    assert_sound(solved(source, target), [source], [target])


@pytest.mark.sweep
@pytest.mark.timeout(900)
@settings(max_examples=600)
@given(pairs())
def test_many_pairs_of_shapes_give_a_sound_morph(pair):
    source, target = pair
    assert_sound(solved(source, target), [source], [target])


def jagged(count: int, seed: int) -> Array:
    """A star with tips and notches at random."""
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.uniform(0, 2 * np.pi, count))
    return rng.uniform(0.3, 1, count)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


@pytest.mark.parametrize("seed", range(6))
def test_a_star_of_very_many_tips_keeps_every_one_against_a_star_of_few(seed):
    many, few = jagged(100 + 20 * seed, seed), jagged(10 + 4 * seed, seed + 100)
    assert_sound(solved(many, few), [many], [few])


@pytest.mark.parametrize("far", [1e6, 1e9])
def test_far_from_the_origin_ends_are_exact_to_the_last_bit_of_the_numbers(far):
    source, target = letter_l() / 5 + far, disc(30) + far
    assert_sound(solved(source, target), [source], [target], tolerance=0)


@pytest.mark.parametrize("width", [1e-2, 1e-3, 1e-4])
def test_a_limb_as_thin_as_a_needle_folds_nowhere(width):
    limb = [[2, 0.5 - width], [2, 0.5], [1, 0.5 + width]]
    source = np.array([[0, 0], [1, 0], [1, 0.5 - width], *limb, [1, 1], [0, 1]])
    assert_sound(solved(source, disc(24)), [source], [disc(24)])


@pytest.mark.parametrize("name", ["tips that meet", "edges that meet", "a keyhole"])
def test_outlines_that_touch_themselves_move_soundly_within_the_hair(name):
    (ring,) = TOUCHING[name]
    source = np.array(ring, float)
    morph = solved(source, disc(24))
    assert [repair.where.side for repair in morph.report.repairs] == ["source"]
    assert_sound(morph, [source], [disc(24)], tolerance=2 * HAIRS[0])


@pytest.mark.sweep
@pytest.mark.parametrize("name", TOUCHING)
def test_every_kind_of_touch_moves_soundly(name):
    source = [np.array(ring, float) for ring in TOUCHING[name]]
    target = [disc(24), *(hole(0.25 * x, 0) for x in (1, -1))][: len(source)]
    assert_sound(solved(source, target), source, target, tolerance=2 * HAIRS[0])


@settings(max_examples=20)
@given(st.data(), pairs())
def test_marks_in_order_give_a_sound_morph_or_an_error_that_names_them(data, pair):
    count = data.draw(st.integers(1, 5))
    places = [
        sorted(data.draw(st.sets(st.integers(0, len(end) - 1), min_size=count, max_size=count)))
        for end in (min(pair, key=len), max(pair, key=len))
    ]
    marks = list(zip(*places, strict=True))
    source, target = sorted(pair, key=len)
    try:
        assert_sound(solved(source, target, marks), [source], [target])
    except MarkError as error:  # neighbours that are one point, or the target runs backwards
        assert error.where.marks and error.hint  # noqa: PT017, PT018 - both outcomes are right


@settings(max_examples=20)
@given(st.data(), st.integers(1, 4))
def test_holes_with_marks_on_any_ring_in_any_order_give_a_sound_morph(data, count):
    ends = []
    for _ in range(2):
        turn = data.draw(st.floats(0, 6.3))
        spots = [0.32 * np.array([np.cos(a), np.sin(a)]) for a in turn + 1.5 * np.arange(count)]
        rings = [disc(24), *(hole(0, data.draw(st.floats(0, 6.3)), spot) for spot in spots)]
        ends.append([ring[:: data.draw(st.sampled_from([1, -1]))] for ring in rings])
    order = [0, *data.draw(st.permutations(range(1, count + 1)))]
    marked = data.draw(st.sets(st.integers(1, count)))
    marks = [((i, data.draw(st.integers(0, 11))), (order[i], 3)) for i in sorted(marked)]
    assert_sound(solved(*ends, marks), *ends)


def test_rings_without_partners_are_refused_by_their_number():
    source, target = [disc(24), hole(0.2, 0)], [disc(24), hole(0.2, 0), hole(-0.2, 0)]
    with pytest.raises(SolveError, match="The source has 1 hole, the target 2") as caught:
        solved(source, target)
    assert "hole 2 of the target" in caught.value.hint
    assert (caught.value.where.side, caught.value.where.ring) == ("target", 2)


@given(st.lists(st.lists(st.floats(width=32), min_size=2, max_size=2), max_size=8))
def test_any_numbers_are_a_morph_or_an_error_that_says_what_to_do(points):
    try:
        assert_sound(solved(points, disc(12)), [np.array(points)], [disc(12)], tolerance=1e-3)
    except OutlineError as error:
        assert error.what and error.hint  # noqa: PT017, PT018 - both outcomes are right
    except MorphError:
        pytest.fail("nothing but the outline can be wrong")


def test_a_shape_that_numbers_can_barely_tell_is_solved():
    """It is opened by a hair that is but ten thousand numbers wide so far from the origin."""
    source = [
        *([1.6530918561973489, 3.332810347510641], [-32.31736433629939, 45.288020651143405]),
        *([-103.3365708049897, 37.84864470970525], [-34.061679917864154, -2.713520703643044]),
        *([-125.0481528652083, -67.67536864462292], [-77.2345017599668, -50.772989241428526]),
        *([-10.43283207525711, -38.12305731323226], [1.2004421730758934, -66.09096637916586]),
    ]
    target = [
        *([-224824.2420239536, -151635.67269299162], [-224824.2421277557, -151635.6730186867]),
        *([-224824.24212966915, -151635.6730583482], [-224824.24237126863, -151635.67275062585]),
        *([-224824.24240338383, -151635.67296411117], [-224824.24236453738, -151635.6731639873]),
        [-224824.24212966915, -151635.6730583482],
    ]
    morph = core.solve(source, target, [(2, 0)], recipe=core.Recipe(density=12))
    assert all(np.isfinite(morph.at(s)).all() for s in (0.25, 0.5, 0.75))
