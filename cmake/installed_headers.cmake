# The headers that are installed: what a host includes, and what those include. Test `house` checks the list.
set(lacuna_installed_headers
    cad/limits.h cad/load.h cad/write_cad.h closure/close.h closure/readings.h core/error.h core/ids.h
    core/message.h core/run_context.h core/types.h fill.h fill/describe.h fill/filled.h fill/volume.h
    geometry/exact.h geometry/newell.h healing/split_facets.h io/cell_field.h io/deck.h io/deck_file.h
    io/facets.h io/formats.h io/leave_out.h io/load_facets.h io/mesh_file.h io/partition.h
    io/whole_file.h matching/match.h matching/side_lines.h mesh/cell_shape.h mesh/hex_mesh.h
    mesh/layered_nodes.h mesh/mesh_part.h mesh/quad_mesh.h mesh/second_order.h mesh/tet_mesh.h quads/region.h
    quality/quality.h surface/requests.h surface/size_field.h sweep/assembly.h sweep/fidelity.h
    sweep/improve.h sweep/second_order_options.h sweep/sweep.h topology/auto_roles.h topology/model.h
    topology/open_volume.h view/page.h view/picture.h)
