"""Isotropic energy densities of a triangle, one a file, as functions of its singular values."""

from core.fem.energies.density import Density, Derivatives
from core.fem.energies.dirichlet import Dirichlet
from core.fem.energies.fairness import Fairness
from core.fem.energies.foldover_free import FoldoverFree
from core.fem.energies.inverse_dirichlet import InverseDirichlet
from core.fem.energies.st_venant_kirchhoff import StVenantKirchhoff
from core.fem.energies.symmetric_dirichlet import SymmetricDirichlet

__all__ = [
    "Density",
    "Derivatives",
    "Dirichlet",
    "Fairness",
    "FoldoverFree",
    "InverseDirichlet",
    "StVenantKirchhoff",
    "SymmetricDirichlet",
]
