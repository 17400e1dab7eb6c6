"""Every format that frames can be exported to; dialogs and the command line are built from it."""

from __future__ import annotations

from app.render.animation import ANIMATION, AnimationFormat
from app.render.png import PNG
from core.io import exporters

ExportFormat = exporters.ExportFormat | AnimationFormat
FORMATS: tuple[ExportFormat, ...] = (PNG, ANIMATION, *exporters.FORMATS)
BY_KEY = {entry.key: entry for entry in FORMATS}
