"""Opening, saving, importing and exporting, from the menu, by drop, and on closing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from app.files import dialogs
from app.files.export_dialog import export_frames
from app.files.export_form import Subject
from app.files.import_dialog import Choice, ask_parts
from app.files.placing import Place, add_layers, add_poses, misplaced, set_key
from app.settings import Settings
from app.workspace import Workspace
from core.errors import FileError
from core.io import importers, project
from core.io.importers import Part, fitted
from core.model import Document


class Files(QObject):
    """The way of documents and shapes between the session and the disk."""

    failed = Signal(object)
    """A MorphError: a file could not be read or written."""
    noted = Signal(str)
    """What an import had to leave out."""

    def __init__(self, workspace: Workspace, settings: Settings, window: QWidget) -> None:
        super().__init__(window)
        self._session, self._selection = workspace.session, workspace.selection
        self._playhead, self._solver = workspace.playhead, workspace.solver
        self._settings, self._window = settings, window

    @property
    def name(self) -> str:
        """What the open project is called."""
        return self._session.path.stem if self._session.path else self.tr("Untitled")

    # -- projects ------------------------------------------------------------------------------

    def new(self) -> bool:
        """Start an empty project; return whether the artist agreed."""
        if not self.may_leave():
            return False
        self._session.replace(Document())
        return True

    def open(self) -> bool:
        """Ask for a project and open it; return whether it was opened."""
        filters = self.tr("Betwixt projects (*{suffix})").format(suffix=project.EXTENSION)
        folder = self._settings.folder("project")
        path = dialogs.ask_open(self._window, self.tr("Open project"), folder, filters)
        return path is not None and self.open_path(path)

    def open_path(self, path: Path) -> bool:
        """Open a project, unless the artist wants to keep the one that is open."""
        document = self._load_instead(path)
        if document is None:
            return False
        self._session.replace(document, path)
        self._remember(path)
        return True

    def open_sample(self, path: Path) -> bool:
        """Open a copy of a sample: it has no file yet, so that saving asks for one."""
        document = self._load_instead(path)
        if document is None:
            return False
        self._session.replace(document)
        return True

    def save(self) -> bool:
        """Save the project where it belongs; return whether it was saved."""
        return self._save_to(self._session.path) if self._session.path else self.save_as()

    def save_as(self) -> bool:
        """Ask where to save the project; return whether it was saved."""
        filters = self.tr("Betwixt projects (*{suffix})").format(suffix=project.EXTENSION)
        start = self._session.path or (
            self._settings.folder("project") / f"{self.name}{project.EXTENSION}"
        )
        path = dialogs.ask_save(self._window, self.tr("Save project"), start, filters)
        if path is None:
            return False
        if path.suffix.lower() != project.EXTENSION:
            path = path.with_name(path.name + project.EXTENSION)
            if path.exists() and not dialogs.ask_replace(self._window, [path]):
                return False
        return self._save_to(path)

    def may_leave(self) -> bool:
        """Return whether the open project can be let go of, after asking about unsaved work."""
        self._session.commit()
        if not self._session.dirty:
            return True
        answer = dialogs.ask_unsaved(self._window, self.name)
        return self.save() if answer == "save" else answer == "discard"

    def _load_instead(self, path: Path) -> Document | None:
        """Load a project to take the place of the open one.

        The artist is asked first: the answer may be to save into the file to be loaded.
        """
        if not self.may_leave():
            return None
        try:
            return project.load(path)
        except FileError as error:
            self.failed.emit(error)
            return None

    def _save_to(self, path: Path) -> bool:
        self._session.commit()
        try:
            project.save(self._session.document, path)
        except FileError as error:
            self.failed.emit(error)
            return False
        self._session.mark_saved(path)
        self._remember(path)
        return True

    def _remember(self, path: Path) -> None:
        self._settings.add_recent(path)
        self._settings.set_folder("project", path.absolute().parent)

    # -- shapes --------------------------------------------------------------------------------

    def import_shapes(self) -> None:
        """Ask for a drawing or point list and import from it."""
        suffixes = [f"*{suffix}" for entry in importers.FORMATS for suffix in entry.suffixes]
        every = self.tr("All shapes ({suffixes})").format(suffixes=" ".join(suffixes))
        filters = ";;".join([every, *(entry.filter for entry in importers.FORMATS)])
        folder = self._settings.folder("import")
        path = dialogs.ask_open(self._window, self.tr("Import shapes"), folder, filters)
        if path:
            self.import_paths([path])

    def import_paths(self, paths: Sequence[Path]) -> None:
        """Import from files; with a choice of parts, and of what they become, if there is one."""
        notes: list[str] = []
        try:
            files = [importers.read(path, notes.append) for path in paths]
        except FileError as error:
            self.failed.emit(error)
            return
        self._settings.set_folder("import", paths[0].absolute().parent)
        self._import(files, notes)

    def import_drawing(self, data: bytes) -> None:
        """Import from an SVG file that is in memory."""
        notes: list[str] = []
        try:
            parts = importers.parse(data, self.tr("Drawing"), importers.SVG, notes.append)
        except FileError as error:
            self.failed.emit(error)
        else:
            self._import([parts], notes)

    def _import(self, files: Sequence[Sequence[Part]], notes: Sequence[str]) -> None:
        document, layer = self._session.document, self._selection.layer
        if layer is None and len(files) == len(files[0]) == 1:
            fit = misplaced(files[0], document.size)
            choice: Choice | None = Choice(tuple(files[0]), Place.LAYERS, fit)
        else:
            choice = ask_parts(self._window, files, document, layer)
        if choice is not None:
            self._place(choice)
            if notes:
                self.noted.emit(" ".join(dict.fromkeys(notes)))

    def _place(self, choice: Choice) -> None:
        document, layer = self._session.document, self._selection.layer
        parts: Sequence[Part] = choice.parts
        if choice.fit:
            parts = fitted(parts, document.size)
        text = self.tr("Import {name}").format(name=parts[0].name)
        if choice.place in (Place.LAYERS, Place.POSES):
            add = add_poses if choice.place is Place.POSES else add_layers
            if self._session.apply(text, add, parts, document.frames[0]):
                self._selection.select_layer(self._session.document.layers[-1].id)
        elif layer is not None:
            frame = self._playhead.frame
            self._session.apply(text, set_key, layer.id, choice.place, parts[0], frame)

    # -- frames --------------------------------------------------------------------------------

    def export(self) -> None:
        """Ask what to export, and write it."""
        self._session.commit()
        self._playhead.stop()
        subject = Subject(self._session.document, self.name, self._playhead, self._solver)
        export_frames(self._window, subject, self._settings)

    # -- drop ----------------------------------------------------------------------------------

    def take(self, paths: Sequence[Path]) -> None:
        """Open the project among dropped files, or else import from all of them."""
        projects = [path for path in paths if path.suffix.lower() == project.EXTENSION]
        if projects:
            self.open_path(projects[0])
        else:
            self.import_paths(paths)
