# SPDX-License-Identifier: MIT
"""The task panel of an analysis: which groups are held, which are pressed, and of what the void is filled."""
import FreeCADGui as Gui
from PySide import QtCore, QtGui

from . import analysis, convert, views

kHeld, kPressed = 1, 2  # columns of the table


def show(void):
    Gui.Control.showDialog(AnalysisPanel(void))


class AnalysisPanel:
    def __init__(self, void):
        self.void = void
        self.form = QtGui.QWidget()
        self.form.setWindowTitle("Analyse the filled void")
        self.form.setWindowIcon(QtGui.QIcon(views.icon("analyse")))
        rows = QtGui.QVBoxLayout(self.form)
        names = list(convert.groups_of_faces(void.FemMesh))
        self.table = QtGui.QTableWidget(len(names), 3)
        self.table.setObjectName("lacuna_groups")
        self.table.setToolTip("Groups of the mesh: a group that is held does not move, one that is pressed is "
                              "under the pressure below")
        self.table.setHorizontalHeaderLabels(["group", "held", "pressed"])
        self.table.verticalHeader().hide()
        for row, name in enumerate(names):
            self.table.setItem(row, 0, QtGui.QTableWidgetItem(name))
            for column in kHeld, kPressed:
                box = QtGui.QTableWidgetItem()
                box.setFlags(QtCore.Qt.ItemIsEnabled)  # a click anywhere in the cell: _toggle()
                box.setCheckState(QtCore.Qt.Unchecked)
                self.table.setItem(row, column, box)
        self.table.cellClicked.connect(self._toggle)
        self.table.resizeColumnsToContents()
        rows.addWidget(self.table, 1)
        options = QtGui.QFormLayout()
        self.pressure = self._number(1.0, "Pressure on the pressed groups, against the surface")
        self.youngs_modulus = self._number(2800.0, "Young's modulus of the filling; 2800 MPa is an epoxy resin")
        self.poissons_ratio = self._number(0.38, "Of the filling; 0.38 is an epoxy resin")
        options.addRow("Pressure [MPa]", self.pressure)
        options.addRow("Modulus [MPa]", self.youngs_modulus)
        options.addRow("Poisson's ratio", self.poissons_ratio)
        rows.addLayout(options)
        self.message = QtGui.QLabel()
        self.message.setWordWrap(True)
        rows.addWidget(self.message)

    @staticmethod
    def _number(value, tip):
        box = QtGui.QDoubleSpinBox()
        box.setRange(-1e9, 1e9)
        box.setDecimals(3)
        box.setValue(value)
        box.setMinimumWidth(60)
        box.setToolTip(tip)
        return box

    def _toggle(self, row, column):
        box = self.table.item(row, column)
        if column != 0:
            checked = box.checkState() == QtCore.Qt.Checked
            box.setCheckState(QtCore.Qt.Unchecked if checked else QtCore.Qt.Checked)

    def _checked(self, column):
        return [self.table.item(row, 0).text() for row in range(self.table.rowCount())
                if self.table.item(row, column).checkState() == QtCore.Qt.Checked]

    def accept(self):
        held, pressed = self._checked(kHeld), self._checked(kPressed)
        if not held or not pressed:
            self.message.setText("Check at least one group that is held and one that is pressed.")
            return False
        document = self.void.Document
        document.openTransaction("Analyse the filled void")
        Gui.doCommand("from lacuna_freecad import analysis")
        Gui.doCommand(f"void = FreeCAD.getDocument({document.Name!r}).getObject({self.void.Name!r})")
        try:
            Gui.doCommand(f"made = analysis.make(void, {held!r}, {pressed!r}, {self.pressure.value()!r}, "
                          f"{self.youngs_modulus.value()!r}, {self.poissons_ratio.value()!r})")
        except (analysis.NoFaces, analysis.HasPyramids, analysis.InUse) as error:
            document.abortTransaction()
            self.message.setText(str(error))
            return False
        Gui.Control.closeDialog()
        Gui.doCommand("results = analysis.solve(made)")
        document.commitTransaction()
        QtCore.QTimer.singleShot(0, lambda: analysis.show_results(document))  # once this panel is gone
        return True

    def reject(self):
        Gui.Control.closeDialog()
        return True

    def getStandardButtons(self):
        return int(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)
