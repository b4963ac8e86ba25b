# SPDX-License-Identifier: MIT
"""Runs inside FreeCAD's window: clicks with the mouse as the page docs/freecad.md says, and counts the clicks.

FreeCAD is started by test_freecad.py with the housing open. LACUNA_PICTURES names the folder for pictures,
LACUNA_VERDICT the file for the verdict. Three of the pictures are those of the page, made smaller by
  convert found.png -crop 1280x655+0+0 +repage -resize 960x +dither -colors 96 PNG8:docs/freecad/found.png
"""
import os
import re
import subprocess
import time
import traceback

import FreeCAD
import FreeCADGui as Gui
from PySide import QtCore, QtGui

from lacuna_freecad import filled_void, job

MOST_CLICKS = 12
SECONDS_A_STEP = 40


def wait_until(condition, what):
    """For `yield from`: until the condition holds."""
    end = time.monotonic() + SECONDS_A_STEP
    while not condition():
        assert time.monotonic() < end, f"waited in vain until {what}"
        yield
    yield


def scroll_to(widget):
    """With the wheel, which is not counted."""
    for area in Gui.getMainWindow().findChildren(QtGui.QScrollArea):
        if area.isAncestorOf(widget):
            area.ensureWidgetVisible(widget)


class Mouse:
    def __init__(self):
        self.clicks = 0

    def click(self, widget, place=None):
        """For `yield from`: with the pointer, in the middle of a widget or at a place in it."""
        yield from wait_until(widget.isVisible, f"{widget} is seen")
        scroll_to(widget)
        point, since = None, None

        def still():
            nonlocal point, since
            now = widget.mapToGlobal(place or widget.rect().center())
            if now != point or QtGui.QApplication.widgetAt(now) is not widget:
                point, since = now, time.monotonic()
            return time.monotonic() > since + 0.5
        yield from wait_until(still, f"{widget} does not move")  # panels unfold
        yield from self.click_at(point)

    def click_at(self, point):
        tool = subprocess.Popen(["xdotool", "mousemove", str(point.x()), str(point.y()), "sleep", "0.1",
                                 "click", "1"])
        self.clicks += 1
        yield from wait_until(lambda: tool.poll() is not None, "the click was sent")
        for _ in range(6):
            yield

    def click_item(self, view, index):
        view.scrollTo(index)
        yield from self.click(view.viewport(), view.visualRect(index).center())

    def choose_workbench(self, name):
        window = Gui.getMainWindow()
        box = next(box for box in window.findChildren(QtGui.QComboBox)
                   if box.isVisible() and box.findText(name) >= 0)
        yield from self.click(box)
        yield from self.click_item(box.view(), box.model().index(box.findText(name), 0))
        yield from wait_until(lambda: Gui.activeWorkbench().MenuText == name, "the workbench is there")

    def press(self, text):
        """A button of a tool bar or the task panel."""
        window = Gui.getMainWindow()
        buttons = []

        def found():
            buttons[:] = [button for button in window.findChildren(QtGui.QAbstractButton) if button.isVisible()
                          and button.isEnabled() and button.text().replace("&", "") == text]
            return buttons
        yield from wait_until(found, f"there is a button {text}")
        yield from self.click(buttons[0])


def picture(name):
    folder = os.environ.get("LACUNA_PICTURES")
    if folder:
        Gui.updateGui()
        Gui.getMainWindow().grab()  # all is drawn
        subprocess.run(["import", "-window", "root", os.path.join(folder, name + ".png")], check=True)


def task_panel():
    return Gui.getMainWindow().findChild(QtGui.QWidget, "lacuna_panel")


def objects(kind):
    return [obj for obj in FreeCAD.ActiveDocument.Objects if obj.isDerivedFrom(kind)]


def tutorial(mouse):
    """From the open file to a solved analysis."""
    yield from wait_until(lambda: FreeCAD.ActiveDocument and FreeCAD.ActiveDocument.Objects, "the part is open")
    Gui.ActiveDocument.ActiveView.viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    picture("open")
    yield from mouse.choose_workbench("Lacuna")
    yield from mouse.press("Fill a void")
    yield from mouse.press("Find")
    yield from wait_until(lambda: "Face16" in field("Faces").text(), "the pocket was found")
    picture("found")
    yield from mouse.press("OK")
    yield from wait_until(lambda: not Gui.Control.activeDialog(), "the void is filled")
    void, = objects("Fem::FemMeshObject")
    assert void.FemMesh.HexaCount > 100 and abs(void.Volume / 27811 - 1) < 0.01, void.Report
    picture("filled")
    yield from mouse.press("Analyse the filled void")
    table = []

    def seen():
        table[:] = Gui.getMainWindow().findChildren(QtGui.QTableWidget, "lacuna_groups")
        return table and table[0].isVisible()
    yield from wait_until(seen, "the groups are listed")
    for group, column in ("source", 1), ("target", 2):
        item = table[0].findItems(group, QtCore.Qt.MatchExactly)[0]
        index = table[0].model().index(item.row(), column)
        yield from mouse.click(table[0].viewport(), table[0].visualRect(index).center())
        assert table[0].item(item.row(), column).checkState() == QtCore.Qt.Checked, group
    picture("analyse")
    yield from mouse.press("OK")
    yield from wait_until(lambda: objects("Fem::FemResultObject"), "CalculiX has solved")
    assert max(objects("Fem::FemResultObject")[0].DisplacementLengths) > 0
    yield from wait_until(Gui.Control.activeDialog, "FreeCAD shows the results")
    yield from mouse.press("Displacement Magnitude")
    picture("solved")
    assert mouse.clicks <= MOST_CLICKS, f"{mouse.clicks} clicks"


def field(role):
    return Gui.getMainWindow().findChild(QtGui.QLineEdit, f"lacuna_{role}")


def undone_and_redone(mouse):
    """Each of the two commands is one step of undo."""
    Gui.ActiveDocument.resetEdit()
    document = FreeCAD.ActiveDocument
    for count in 1, 0:
        yield from press_undo(mouse)
        assert len(objects("Fem::FemMeshObject")) >= count and not objects("Fem::FemAnalysis")
    assert [obj.Name for obj in document.Objects] == ["Solid"], [obj.Name for obj in document.Objects]
    document.redo()
    document.recompute()
    void, = objects("Fem::FemMeshObject")
    assert void.FemMesh.HexaCount > 100 and void.Label == "Filled void"
    document.undo()


def press_undo(mouse):
    yield from mouse.press("Undo")


def changed(mouse):
    """A double click on the void opens its panel; a change is one step of undo."""
    void, = objects("Fem::FemMeshObject")
    cells = void.FemMesh.HexaCount
    void.ViewObject.doubleClicked()
    yield from wait_until(task_panel, "the panel is open")
    task_panel().findChild(QtGui.QDoubleSpinBox, "lacuna_Size").setValue(2)
    yield from mouse.press("OK")
    yield from wait_until(lambda: not Gui.Control.activeDialog(), "the panel is closed")
    assert void.Size.Value == 2 and void.FemMesh.HexaCount > cells
    finer = void.FemMesh.HexaCount
    FreeCAD.ActiveDocument.undo()
    assert void.Size.Value == 0 and void.FemMesh.HexaCount == cells < finer


def recorded():
    """What the commands did stands in the Python console, and does the same again."""
    console = Gui.getMainWindow().findChild(QtGui.QPlainTextEdit, "Python console")
    lines = [line[4:] for line in console.toPlainText().splitlines() if line.startswith(">>> ")]
    wanted = [line for line in lines if re.match(r"from lacuna_freecad|void[ .]|FreeCAD.getDocument", line)]
    assert any(line.startswith("void.Faces = ") for line in wanted), wanted
    exec("\n".join(wanted), {"FreeCAD": FreeCAD})
    void, = objects("Fem::FemMeshObject")
    assert void.FemMesh.HexaCount > 100
    yield


def refused_and_stopped(mouse):
    """An error names a face that a click selects; a long job is stopped, and what it began is taken back."""
    document = FreeCAD.ActiveDocument
    before = len(document.Objects)
    yield from mouse.press("Fill a void")
    panel = [None]
    yield from wait_until(lambda: panel.__setitem__(0, task_panel()) or panel[0], "the panel is open")
    yield from mouse.press("Take")
    assert field("Faces").text() == "" and "first" in panel[0].findChild(QtGui.QLabel, "lacuna_free").text()
    Gui.Selection.addSelection(document.Solid, "Face16")
    yield from mouse.press("Take")
    assert field("Faces").text() == "Face16"
    field("Faces").clear()
    for role in "Source", "Target":
        field(role).setText("Face16")
    yield from mouse.press("OK")
    report = panel[0].findChild(QtGui.QTextBrowser)
    yield from wait_until(lambda: "Face16" in report.toPlainText(), "the error is shown")
    assert 'href="Face16"' in report.toHtml(), report.toHtml()
    picture("refused")
    Gui.Selection.clearSelection()
    cursor = report.document().find("Face16")
    yield from mouse.click_at(report.mapToGlobal(report.cursorRect(cursor).center() - QtCore.QPoint(8, 0)))
    selected, = Gui.Selection.getSelectionEx()
    assert selected.SubElementNames == ("Face16",), selected.SubElementNames
    field("Target").clear()
    panel[0].findChild(QtGui.QDoubleSpinBox, "lacuna_Size").setValue(0.1)
    panel[0].findChild(QtGui.QSpinBox, "lacuna_Layers").setValue(500)
    yield from mouse.press("OK")
    yield from wait_until(lambda: job.running and job.running[0].stage != "starting", "the job runs")
    process = job.running[0].process
    picture("running")
    yield from mouse.press("Stop")
    yield from wait_until(lambda: "stopped" in report.toPlainText(), "the job is stopped")
    assert not job.running and not os.path.exists(f"/proc/{process}")
    yield from mouse.press("Cancel")
    yield from wait_until(lambda: not Gui.Control.activeDialog(), "the panel is closed")
    assert len(document.Objects) == before, [obj.Name for obj in document.Objects]


def recompute_stopped():
    """A change of the part fills the void anew, behind a bar with a stop button."""
    part = FreeCAD.ActiveDocument.Solid
    void = filled_void.make(part, [f"Face{number}" for number in (7, 8, 9, 10, 11, 12, 13, 14, 16, 18)])
    void.Size, void.Layers = 0.1, 500
    shown = []

    def stop():
        bar, = (bar for bar in Gui.getMainWindow().findChildren(QtGui.QProgressDialog) if bar.isVisible())
        picture("recomputing")
        shown.append(bar.value())
        bar.findChild(QtGui.QPushButton).click()
    QtCore.QTimer.singleShot(2500, stop)
    FreeCAD.ActiveDocument.recompute()
    assert not void.isValid() and "stopped" in void.Report[0], void.Report
    assert not job.running and shown[0] > 0, shown
    FreeCAD.ActiveDocument.removeObject(void.Name)
    FreeCAD.ActiveDocument.recompute()
    yield


def closed_while_it_runs(mouse):
    """A document that is closed during a job leaves nothing running, and no panel."""
    yield from mouse.press("Fill a void")
    yield from wait_until(task_panel, "the panel is open")
    field("Source").setText("Face16")
    task_panel().findChild(QtGui.QDoubleSpinBox, "lacuna_Size").setValue(0.1)
    yield from mouse.press("OK")
    yield from wait_until(lambda: job.running and job.running[0].stage != "starting", "the job runs")
    process, folder = job.running[0].process, job.running[0].folder
    FreeCAD.closeDocument(FreeCAD.ActiveDocument.Name)
    yield from wait_until(lambda: not Gui.Control.activeDialog(), "the panel is closed")
    assert not job.running and not os.path.exists(f"/proc/{process}") and not os.path.exists(folder)


def scenes():
    mouse = Mouse()
    yield from tutorial(mouse)
    verdict = f"{mouse.clicks} clicks from the open file to the coloured results"
    yield from undone_and_redone(mouse)
    yield from recorded()
    yield from changed(mouse)
    yield from refused_and_stopped(mouse)
    yield from recompute_stopped()
    yield from closed_while_it_runs(mouse)
    return verdict


class Driver:
    def __init__(self):
        self.steps = scenes()
        self.timer = QtCore.QTimer()
        self.timer.timeout.connect(self.step)
        self.timer.start(50)

    def step(self):
        try:
            next(self.steps)
        except StopIteration as done:
            self.end(f"passed: {done.value}")
        except Exception:
            picture("failed")
            self.end(traceback.format_exc())

    def end(self, verdict):
        self.timer.stop()
        with open(os.environ["LACUNA_VERDICT"], "w") as file:
            file.write(verdict)
        os._exit(0)  # without a question about unsaved documents


driver = Driver()
