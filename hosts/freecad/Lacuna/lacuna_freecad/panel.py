# SPDX-License-Identifier: MIT
"""The task panel of a filled void: its faces, options and report. A job runs beside it, with a stop button.

All that the panel does to the document is one transaction, and is written to macros as Python.
"""
import re

import FreeCAD
import FreeCADGui as Gui
from PySide import QtCore, QtGui

from . import convert, filled_void, views
from . import job as jobs

kPollMilliseconds = 100  # how often the panel asks a job how far it is: a choice
OPTIONS = [option for option in filled_void.OPTIONS if option[0] not in ("Part", *convert.ROLES)]
kTransparency = 60  # of a part with a filled void, in per cent: a choice
FIRST = "Size", "Layers", "Order", "Fallback"  # options that are always shown


def edit(void, transaction):
    """Open the panel for a void. The transaction may be open already, with the void made in it."""
    if Gui.Control.activeDialog():
        raise RuntimeError("Close the open task panel first.")
    if not void.Part:
        raise RuntimeError("The filled void has no part: set its property Part.")
    if not void.Document.HasPendingTransaction:
        void.Document.openTransaction(transaction)
    Gui.Control.showDialog(Panel(void))


def with_links(text):
    """Text as HTML in which names of faces can be clicked."""
    text = text.replace("&", "&amp;").replace("<", "&lt;")
    return re.sub(r"\b(Face\d+)\b", r'<a href="\1">\1</a>', text)


class Panel:
    def __init__(self, void):
        self.void = void
        self.job = None
        self._when_done = None
        self._document = void.Document.Name
        self._edges = views.RedEdges(Gui.getDocument(self._document).ActiveView)
        self._make_form()
        self._timer = QtCore.QTimer()
        self._timer.setInterval(kPollMilliseconds)
        self._timer.timeout.connect(self._poll)
        self._show_report(void.Report)
        self._show_free_edges()
        FreeCAD.addDocumentObserver(self)

    # --- the form -------------------------------------------------------------------------------------------

    def _make_form(self):
        self.form = QtGui.QWidget()
        self.form.setObjectName("lacuna_panel")
        self.form.setWindowTitle("Fill a void")
        self.form.setWindowIcon(QtGui.QIcon(views.icon("filled_void")))
        rows = QtGui.QVBoxLayout(self.form)
        rows.addLayout(self._find_row())
        rows.addLayout(self._role_rows())
        self.free = QtGui.QLabel()
        self.free.setObjectName("lacuna_free")
        self.free.setWordWrap(True)
        self.free.setToolTip("Edges of these faces with a missing face beside them, red in the 3-D view")
        rows.addWidget(self.free)

        self.options = {}
        rows.addLayout(self._option_rows(lambda name: name in FIRST))
        more = self._button("More options", "Options that are seldom needed", lambda shown: rest.setVisible(shown))
        more.setCheckable(True)
        rows.addWidget(more)
        rest = QtGui.QWidget()
        rest.setLayout(self._option_rows(lambda name: name not in FIRST))
        rest.hide()
        rows.addWidget(rest)
        self._shown = {name: self._value(name) for name in self.options}

        rows.addLayout(self._progress_row())
        self.stage = QtGui.QLabel()
        self.stage.setSizePolicy(QtGui.QSizePolicy.Ignored, QtGui.QSizePolicy.Preferred)  # paths are long
        self.stage.hide()
        rows.addWidget(self.stage)
        self.report = QtGui.QTextBrowser()
        self.report.setToolTip("What was done. A click on a face selects it in the 3-D view")
        self.report.setMinimumSize(60, 120)
        self.report.setOpenLinks(False)
        self.report.anchorClicked.connect(lambda link: self._select([link.toString()]))
        rows.addWidget(self.report, 1)

    def _find_row(self):
        self.find_button = self._button("Find", "Find the voids of the part, or the roles of the faces below",
                                        self.find)
        self.voids = QtGui.QComboBox()
        self.voids.setMinimumWidth(60)
        self.voids.setToolTip("The voids that were found; the faces of the chosen one are taken")
        self.voids.activated.connect(self._take_void)
        row = QtGui.QHBoxLayout()
        row.addWidget(self.find_button)
        row.addWidget(self.voids, 1)
        return row

    def _role_rows(self):
        self.roles = {}
        meanings = {option[0]: option[4] for option in filled_void.OPTIONS}
        grid = QtGui.QGridLayout()
        for row, role in enumerate(convert.ROLES):
            names = convert.face_names(convert.face_numbers(getattr(self.void, role)))
            field = QtGui.QLineEdit(", ".join(names))
            field.setMinimumWidth(60)
            field.setObjectName(f"lacuna_{role}")
            field.setToolTip(meanings[role])
            field.textChanged.connect(self._show_free_edges)
            self.roles[role] = field
            take = self._button("Take", f"Take the faces that are selected in the 3-D view as {role.lower()}",
                                lambda _=False, role=role: self._take_selection(role))
            for column, widget in enumerate((QtGui.QLabel(role), field, take)):
                grid.addWidget(widget, row, column)
        return grid

    def _progress_row(self):
        self.bar = QtGui.QProgressBar()
        self.bar.setRange(0, 1)
        self.bar.setFormat("")
        self.stop_button = self._button("Stop", "Stop the job; the document stays as it is", self.stop)
        self.stop_button.setEnabled(False)
        row = QtGui.QHBoxLayout()
        row.addWidget(self.bar, 1)
        row.addWidget(self.stop_button)
        return row

    def _option_rows(self, wanted):
        rows = QtGui.QFormLayout()
        rows.setContentsMargins(0, 0, 0, 0)
        for name, kind, _, value, meaning in OPTIONS:
            if wanted(name):
                widget = self._widget(kind, value, getattr(self.void, name))
                widget.setObjectName(f"lacuna_{name}")
                widget.setToolTip(meaning)
                widget.setMinimumWidth(60)
                self.options[name] = widget
                rows.addRow(re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name), widget)
        return rows

    @staticmethod
    def _button(text, tip, action):
        button = QtGui.QPushButton(text)
        button.setToolTip(tip)
        button.clicked.connect(action)
        return button

    @staticmethod
    def _widget(kind, value, now):
        if kind == "App::PropertyEnumeration":
            widget = QtGui.QComboBox()
            widget.addItems(value)
            widget.setCurrentText(now)
        elif kind == "App::PropertyBool":
            widget = QtGui.QCheckBox()
            widget.setChecked(now)
        elif kind == "App::PropertyInteger":
            widget = QtGui.QSpinBox()
            widget.setMaximum(1000000)
            widget.setSpecialValueText("automatic")
            widget.setValue(now)
        else:
            widget = QtGui.QDoubleSpinBox()
            widget.setDecimals(4)
            if kind == "App::PropertyLength":
                widget.setMaximum(1000000)
                widget.setSuffix(" mm")
                widget.setSpecialValueText("automatic")
            else:
                widget.setRange(0, 1)
                widget.setSingleStep(0.1)
            widget.setValue(getattr(now, "Value", now))
        return widget

    def _value(self, name):
        widget = self.options[name]
        if isinstance(widget, QtGui.QComboBox):
            return widget.currentText()
        return widget.isChecked() if isinstance(widget, QtGui.QCheckBox) else widget.value()

    # --- faces ----------------------------------------------------------------------------------------------

    def _numbers(self, role):
        return sorted({int(number) for number in re.findall(r"\d+", self.roles[role].text())})

    def _take_selection(self, role):
        names = [name for part, faces in views.selected_faces(self._document) if part == self.void.Part
                 for name in faces]
        if not names:
            self.free.setText(f"Select faces of {self.void.Part.Label} in the 3-D view first")
            return
        self.roles[role].setText(", ".join(names))
        Gui.Selection.clearSelection()
        self._show_free_edges()

    def _show_free_edges(self):
        shape = self.void.Part.Shape
        numbers = sorted(set().union(*(self._numbers(role) for role in convert.ROLES)))
        unknown = [number for number in numbers if not 1 <= number <= len(shape.Faces)]
        if unknown:
            self.free.setText(f"{self.void.Part.Label} has no {convert.face_names(unknown)[0]}")
            return
        edges = convert.free_edges(shape, numbers)
        self._edges.show(edges)
        closed = "No free edges" if numbers else "A closed part: Find lists its voids, OK fills the part itself"
        self.free.setText(f"{len(edges)} free edges" if edges else closed)

    def _select(self, names):
        Gui.Selection.clearSelection()
        for name in names:
            Gui.Selection.addSelection(self.void.Part, name)

    # --- jobs -----------------------------------------------------------------------------------------------

    def find(self):
        roles = {role.lower(): self._numbers(role) for role in convert.ROLES if self._numbers(role)}
        if "faces" not in roles and roles and "walls" not in roles:
            roles["walls"] = "auto"
        shape = self.void.Part.Shape
        request = convert.request_for("find", shape, roles)
        self._start(lambda: jobs.Job(shape, request, self._document), self._found)

    def _found(self, _, result):
        if result["report"]:
            self._show_report(result["report"])
        self.voids.clear()
        for void in result["voids"]:
            self.voids.addItem(f"{void['kind']}, {void['volume']:.0f} mm³", void["faces"])
        if result["voids"]:
            self._take_void(0)

    def _take_void(self, index):
        for role in convert.ROLES:
            self.roles[role].clear()
        names = convert.face_names(self.voids.itemData(index))
        self.roles["Faces"].setText(", ".join(names))
        self._select(names)
        self._show_free_edges()

    def _start(self, make_job, when_done):
        try:
            self.job, self._when_done = make_job(), when_done
        except jobs.Failed as error:
            self._show_error(error)
            return
        self._busy(True)
        self._timer.start()

    def _poll(self):
        self.stage.setText(self.job.stage)
        self.bar.setRange(0, 100 if self.job.share > 0 else 0)  # 0 to 0: the bar shows that something runs
        self.bar.setValue(round(100 * self.job.share))
        self.stage.show()
        if not self.job.done():
            return
        job, self.job = self.job, None
        self._timer.stop()
        self._busy(False)
        try:
            self._when_done(job, job.result())
        except jobs.Failed as error:
            self._show_error(error)
        finally:
            job.stop()

    def stop(self):
        if self.job:
            self.job.stop()

    def _busy(self, busy):
        self.stop_button.setEnabled(busy)
        self.find_button.setEnabled(not busy)
        self.bar.setRange(0, 0 if busy else 1)
        self.bar.reset()
        self.stage.hide()

    # --- the report -----------------------------------------------------------------------------------------

    def _show_report(self, lines):
        self._show("".join(f"<div>{with_links(line)}</div>" for line in lines))

    def _show_error(self, error):
        lines = [f'<p style="color: #c00000">{with_links(str(error))}</p>']
        lines += [f"<p>{with_links(attempt)}</p>" for attempt in error.attempts]
        self._show("".join(lines) + f"<p>[{error.code}]</p>")
        self._select(convert.face_names(error.faces))

    def _show(self, html):
        self.report.setHtml(html)
        if html:
            QtCore.QTimer.singleShot(0, self._scroll_to_report)

    def _scroll_to_report(self):
        for area in Gui.getMainWindow().findChildren(QtGui.QScrollArea):
            if area.isAncestorOf(self.report):
                area.ensureWidgetVisible(self.report)

    # --- the document ---------------------------------------------------------------------------------------

    def _write_properties(self):
        Gui.doCommand(f"void = FreeCAD.getDocument({self._document!r}).getObject({self.void.Name!r})")
        for role in convert.ROLES:
            numbers = self._numbers(role)
            if numbers != convert.face_numbers(getattr(self.void, role)):
                value = f"(void.Part, {convert.face_names(numbers)!r})" if numbers else "None"
                Gui.doCommand(f"void.{role} = {value}")
        for name, shown in self._shown.items():
            if self._value(name) != shown:  # a property may have more digits than are shown
                Gui.doCommand(f"void.{name} = {self._value(name)!r}")
                self._shown[name] = self._value(name)

    def _filled(self, job, _):
        self.void.Proxy.deliver(job)
        Gui.doCommand(f"FreeCAD.getDocument({self._document!r}).recompute()")
        if not self.void.isValid():
            self._show_report(self.void.Report)
            return
        view = self.void.Part.ViewObject
        if hasattr(view, "Transparency"):  # the mesh is seen through the part
            view.Transparency = max(view.Transparency, kTransparency)
        self._close()
        self.void.Document.commitTransaction()

    def accept(self):
        if self.job is None:
            self._write_properties()
            self._start(lambda: filled_void.start(self.void), self._filled)
        return False  # it closes when the job is done

    def reject(self):
        self.stop()
        self._close()
        FreeCAD.getDocument(self._document).abortTransaction()
        filled_void.refresh(FreeCAD.getDocument(self._document))
        return True

    def getStandardButtons(self):
        return int(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)

    def isAllowedAlterSelection(self):
        return True

    def isAllowedAlterView(self):
        return True

    def _close(self):
        self._timer.stop()
        self._edges.remove()
        Gui.Selection.clearSelection()
        self._leave()

    def slotDeletedDocument(self, document):
        if document.Name == self._document:
            self._timer.stop()
            QtCore.QTimer.singleShot(0, self._leave)  # an observer cannot be removed while it is told

    def _leave(self):
        FreeCAD.removeDocumentObserver(self)
        Gui.Control.closeDialog()
