// SPDX-License-Identifier: MIT
#include <lacuna/io/mesh_file.h>

namespace lacuna::io {

void write_msh_options(const OutputPath& path)
{
    WholeFile file(path);
    file.append(
        "// How Gmsh shows the mesh in the same folder: cells and their edges, coloured by physical group.\n"
        "// Tools > Options > Mesh > Color changes the colours; without this file Gmsh shows only lines.\n"
        "Mesh.ColorCarousel = 2;\n"
        "Mesh.SurfaceFaces = 1;\n"
        "Mesh.SurfaceEdges = 1;\n"
        "Mesh.VolumeFaces = 0; // 1 to show faces of cells that a clipping plane exposes\n"
        "Mesh.VolumeEdges = 0;\n"
        "Mesh.Lines = 0;\n"
        "Mesh.Points = 0;\n"
        "Mesh.Light = 1;\n"
        "General.ClipWholeElements = 1;\n"
        "General.ClipOnlyDrawIntersectingVolume = 0;\n"
        "General.Color.Background = {255, 255, 255};\n"
        "General.Color.Foreground = {40, 50, 60};\n"
        "General.Color.Text = {40, 50, 60};\n"
        "Mesh.Color.Lines = {20, 28, 38};\n"
        "If(PostProcessing.NbViews > 0)\n"
        "  View[0].Visible = 0; // the quality, which would hide the groups\n"
        "EndIf\n");
    file.commit();
}

} // namespace lacuna::io
