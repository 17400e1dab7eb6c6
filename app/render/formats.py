"""Every format that frames can be exported to; dialogs and the command line are built from it."""

from app.render.png import PNG
from core.io import exporters

FORMATS: tuple[exporters.ExportFormat, ...] = (PNG, *exporters.FORMATS)
BY_KEY = {entry.key: entry for entry in FORMATS}
