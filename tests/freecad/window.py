# SPDX-License-Identifier: MIT
"""Runs inside FreeCAD's window: clicks with the mouse as the page docs/freecad.md says, and counts the clicks.

FreeCAD is started by test_window.py with the housing open. LACUNA_PICTURES names the folder for pictures,
LACUNA_VERDICT the file for the verdict.
"""
import os
import subprocess
import time
import traceback

import FreeCAD
import FreeCADGui as Gui
from PySide import QtCore, QtGui

MOST_CLICKS = 12
SECONDS_A_STEP = 40


def wait_until(condition, what):
    """For `yield from`: until the condition holds."""
    end = time.monotonic() + SECONDS_A_STEP
    while not condition():
        assert time.monotonic() < end, f"waited in vain until {what}"
        yield
    yield


class Mouse:
    def __init__(self):
        self.clicks = 0

    def click(self, widget, place=None):
        """For `yield from`: with the pointer, in the middle of a widget or at a place in it."""
        yield from wait_until(widget.isVisible, f"{widget} is seen")
        point, still = None, 0
        while still < 5:  # panels unfold
            now = widget.mapToGlobal(place or widget.rect().center())
            point, still = now, still + 1 if now == point else 0
            yield
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
                          and button.isEnabled() and text in (button.text().replace("&", ""), button.toolTip())]
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
    yield from wait_until(lambda: "Face16" in faces_field().text(), "the pocket was found")
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
    picture("solved")
    assert mouse.clicks <= MOST_CLICKS, f"{mouse.clicks} clicks"


def faces_field():
    return Gui.getMainWindow().findChild(QtGui.QLineEdit, "lacuna_Faces")


def scenes():
    mouse = Mouse()
    yield from tutorial(mouse)
    return f"{mouse.clicks} clicks from the open file to the solved analysis"


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
