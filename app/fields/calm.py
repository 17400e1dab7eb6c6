"""What keeps a field calm while a panel is scrolled over it."""

from __future__ import annotations

from PySide6.QtGui import QWheelEvent


class CalmWheel:
    """Inherited before a widget's class: the wheel changes it only while it has the focus."""

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Leave the wheel to the panel, unless this is being edited."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()
