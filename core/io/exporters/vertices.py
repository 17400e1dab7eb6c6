"""Raw vertex frames for other tools, as NumPy archives."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from core.errors import FileError
from core.io.exporters.film import Film, Size
from core.io.naming import file_in
from core.io.replacing import replacing, staging
from core.progress import Progress


def write_vertices(
    path: Path,
    positions: ArrayLike,
    triangles: ArrayLike,
    rings: Sequence[ArrayLike],
    times: ArrayLike,
    **more: ArrayLike,
) -> None:
    """Write one moving mesh as an ``.npz`` archive.

    It holds ``positions`` (frames, n, 2), ``triangles`` (m, 3), ``rings`` (k,) the boundary's
    vertex indices, ring after ring, ``ring_sizes`` (r,) their lengths, exterior first, and
    ``times`` (frames,) in seconds; ``more`` are further arrays.
    """
    boundary = [np.asarray(ring, dtype=np.int64) for ring in rings]
    arrays = {
        "positions": np.asarray(positions, dtype=float),
        "triangles": np.asarray(triangles, dtype=np.int64).reshape(-1, 3),
        "rings": np.concatenate(boundary),
        "ring_sizes": np.array([len(ring) for ring in boundary]),
        "times": np.asarray(times, dtype=float),
        **{name: np.asarray(value) for name, value in more.items()},
    }
    with replacing(path) as draft, draft.open("wb") as file:
        np.savez_compressed(file, allow_pickle=False, **arrays)


class VertexFormat:
    """One archive for each layer and span; see ``write_vertices``."""

    key = "npz"
    """Its name on the command line."""
    name = "Vertex frames (NumPy)"
    suffix = ".npz"
    paints = False
    """Size and background mean nothing to it."""

    def count(self, film: Film) -> int:
        """Return how many files a film makes."""
        return film.mesh_count

    def file_name(self, film: Film, stem: str, index: int) -> str:
        """Return what one of these files is called."""
        number = f"-{index + 1}" if film.mesh_count > 1 else ""
        return f"{stem}{number}{self.suffix}"

    def export(
        self, film: Film, folder: Path, stem: str, size: Size | None, progress: Progress
    ) -> list[Path]:
        """Write every mesh of a film; all files or none. Return the paths."""
        meshes = film.meshes
        if not meshes:
            raise FileError("There is no mesh to export.")
        names = []
        done, total = 0, sum(len(mesh.frames) for mesh in meshes)
        with staging(folder) as draft:
            for i, mesh in enumerate(meshes):
                positions = []
                for k in range(len(mesh.frames)):
                    progress((done + k) / total, f"Mesh {i + 1} of {len(meshes)}")
                    positions.append(mesh.positions[k])
                done += len(positions)
                name = self.file_name(film, stem, i)
                write_vertices(
                    file_in(draft, name),
                    positions,
                    mesh.triangles,
                    mesh.rings,
                    mesh.times,
                    frames=mesh.frames,
                    layer=mesh.layer,
                )
                names.append(name)
            progress(1.0, "Done")
        return [folder / name for name in names]


VERTICES = VertexFormat()
