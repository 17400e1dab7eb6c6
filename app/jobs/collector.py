"""Python's cyclic garbage collection, kept to the UI thread."""

from __future__ import annotations

import gc

from PySide6.QtCore import QObject, QTimer

EVERY = 250
"""Milliseconds between looks at what has piled up."""


class Collector(QObject):
    """Collects garbage in the thread that it was made in, instead of in whichever allocates.

    Unreachable widgets and timers are found by the collector too, and Qt's objects may only die
    in their own thread: a timer that a worker frees goes on firing into freed memory.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        gc.disable()
        gc.freeze()  # what is imported stays
        self._timer = QTimer(self, interval=EVERY)
        self._timer.timeout.connect(self.collect)
        self._timer.start()

    def collect(self) -> None:
        """Collect the oldest generation that is due by Python's own limits, and the younger."""
        due = [
            count > limit for count, limit in zip(gc.get_count(), gc.get_threshold(), strict=True)
        ]
        for generation in (2, 1, 0):
            if due[generation]:
                gc.collect(generation)
                return
