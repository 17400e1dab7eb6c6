"""Mends rings that meet themselves or each other where they should not.

Every place where the outline meets itself becomes a node of all the walks that pass through it.
Then what goes forth and back is cut off, and so are small loops; and where several passes share a
node, they are opened there by a hair.

All lengths are fractions of the outline's diagonal: the rings come at unit size.
"""


class BeyondRepair(Exception):  # noqa: N818 - says what is so
    """Mending would change the shape; ``flat`` is a ring of which nothing would be left."""

    def __init__(self, flat: int | None = None) -> None:
        super().__init__()
        self.flat = flat
