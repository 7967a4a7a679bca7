// Versions that Qt 5.10 and Qt 6 both have; nothing of Cura's own, which is called differently in Cura 4 and 5.
import QtQuick 2.10
import QtQuick.Controls 2.3
import QtQuick.Layouts 1.3
import QtQuick.Window 2.2

Window
{
    id: dialog
    title: "Aplomb"
    modality: Qt.ApplicationModal
    flags: Qt.Dialog
    width: content.implicitWidth + 40
    height: content.implicitHeight + 40
    minimumWidth: width
    minimumHeight: height
    color: "#ffffff"

    property var aims: ["least", "light", "stable"]
    property var deforms: ["never", "auto", "only"]

    function load() { fill(function(key) { return manager.value(key) }) }

    function fill(value)
    {
        tip.text = Number(value("tip_deg")).toString()
        wall.text = Number(value("wall_mm")).toString()
        aim.currentIndex = aims.indexOf(value("aim"))
        deform.currentIndex = deforms.indexOf(value("deform"))
        robust.checked = value("robust")
        fromCura.checked = value("from_cura")
    }

    function save()
    {
        manager.setValues({
            "tip_deg": tip.text, "wall_mm": wall.text, "aim": aims[aim.currentIndex], "deform": deforms[deform.currentIndex],
            "robust": robust.checked, "from_cura": fromCura.checked
        })
        dialog.close()
    }

    Shortcut { sequence: "Esc"; onActivated: dialog.close() }

    ColumnLayout
    {
        id: content
        x: 20
        y: 20
        width: dialog.width - 40
        spacing: 12

        GridLayout
        {
            columns: 3
            columnSpacing: 12
            rowSpacing: 10

            Label { text: "Stands up to a tilt of"; color: "#111111" }
            TextField { id: tip; objectName: "tip"; selectByMouse: true; Layout.fillWidth: true; validator: DoubleValidator { bottom: 0; top: 89 } }
            Label { text: "degrees"; color: "#111111" }

            Label { text: "Wall round a void, at least"; color: "#111111" }
            TextField { id: wall; objectName: "wall"; selectByMouse: true; Layout.fillWidth: true; validator: DoubleValidator { bottom: 0.1; top: 100 } }
            Label { text: "mm"; color: "#111111" }

            Label { text: "Take away"; color: "#111111" }
            ComboBox
            {
                id: aim
                objectName: "aim"
                Layout.columnSpan: 2
                Layout.minimumWidth: 300
                model: ["as little as makes it stand", "as much as it can spare", "what makes it stand best"]
            }

            Label { text: "The outside may change"; color: "#111111" }
            ComboBox
            {
                id: deform
                Layout.columnSpan: 2
                Layout.minimumWidth: 300
                model: ["never", "where no void serves", "instead of a void"]
            }
        }

        CheckBox { id: robust; text: "Also at the worst of the printer's tolerances" }
        CheckBox { id: fromCura; text: "Reckon with the infill, layer height and filament set in Cura" }

        RowLayout
        {
            Layout.topMargin: 8
            Button { text: "Defaults"; onClicked: { var d = manager.defaults(); dialog.fill(function(key) { return d[key] }) } }
            Item { Layout.fillWidth: true }
            Button { text: "Cancel"; onClicked: dialog.close() }
            Button { text: "Save"; objectName: "save"; highlighted: true; onClicked: dialog.save() }
        }
    }
}
