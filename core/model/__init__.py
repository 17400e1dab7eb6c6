"""What the artist made: frozen, cheap to share, compared by value."""

from core.model.document import Document
from core.model.easing import Easing
from core.model.layer import Keyframe, Layer
from core.model.outline import Outline, Ring, RingPoint
from core.model.recipe import Recipe
from core.model.style import Style
from core.model.turning import Turning

__all__ = [
    "Document",
    "Easing",
    "Keyframe",
    "Layer",
    "Outline",
    "Recipe",
    "Ring",
    "RingPoint",
    "Style",
    "Turning",
]
