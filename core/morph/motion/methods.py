"""The ways of drawing in-betweens that a recipe can name."""

from core.model.recipe import Method
from core.morph.motion.interpolate import Interpolate
from core.morph.motion.intrinsic import Intrinsic
from core.morph.motion.linear import Linear
from core.morph.motion.rigid import PlainRigid, Rigid

METHODS: dict[Method, type[Interpolate]] = {
    "arap": Rigid,
    "plain arap": PlainRigid,
    "linear": Linear,
    "intrinsic": Intrinsic,
}
