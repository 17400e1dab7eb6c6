import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core.geometry.rotation import (
    signed_singular_values,
    turn_and_mirror,
    unit,
    unwrap,
)

matrices = st.lists(st.floats(-3, 3), min_size=4, max_size=4).map(
    lambda entries: np.array(entries).reshape(1, 2, 2)
)


@given(matrices)
def test_the_turn_is_the_closest_rotation_scaled(F):
    turn, _ = turn_and_mirror(F)
    c, s = unit(turn)[0].real, unit(turn)[0].imag
    stretch = np.array([[c, s], [-s, c]]) @ F[0]
    assert np.allclose(stretch, stretch.T)
    assert np.trace(stretch) >= 0


@given(matrices)
def test_signed_singular_values_carry_the_sign_of_the_determinant(F):
    s1, s2 = (s[0] for s in signed_singular_values(F))
    assert np.allclose([s1, abs(s2)], np.linalg.svd(F[0], compute_uv=False))
    assert np.isclose(s1 * s2, np.linalg.det(F[0]))


@given(matrices, st.complex_numbers(max_magnitude=5))
def test_turn_and_mirror_act_on_complex_numbers_as_the_matrix_does(F, z):
    turn, mirror = (part[0] for part in turn_and_mirror(F))
    x, y = F[0] @ [z.real, z.imag]
    assert np.isclose(turn * z + mirror * z.conjugate(), x + 1j * y)


def test_unwrapping_follows_a_spiral_through_several_turns():
    truth = np.linspace(0, 9 * np.pi, 200)
    wrapped = (truth + np.pi) % (2 * np.pi) - np.pi
    neighbours = np.column_stack([np.arange(199), np.arange(1, 200)])
    out = unwrap(wrapped, neighbours, np.ones(200))
    assert np.allclose(np.diff(out), np.diff(truth))
    assert -np.pi <= out.mean() < np.pi


@given(st.permutations(range(30)))
def test_unwrapping_does_not_depend_on_the_numbering(order):
    truth = np.linspace(-1, 12, 30)
    neighbours = np.column_stack([np.arange(29), np.arange(1, 30)])
    plain = unwrap((truth + np.pi) % (2 * np.pi) - np.pi, neighbours, np.ones(30))
    order = np.array(order)
    place = np.argsort(order)
    shuffled = unwrap((truth[order] + np.pi) % (2 * np.pi) - np.pi, place[neighbours], np.ones(30))
    assert np.allclose(shuffled, plain[order])


def test_unwrapping_leaves_what_nothing_connects_as_it_is():
    out = unwrap(
        np.array([0.0, 3.0, -3.0, 1.0, 2.0]), np.array([[0, 1], [1, 2], [3, 4]]), np.ones(5)
    )
    assert np.allclose(out, [0, 3, 2 * np.pi - 3, 1, 2])
