// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/cad_worker/detail/solid_file.h>
#include <lacuna/core/shared/criteria.h>

#include <cmath>
#include <map>

#include <sys/resource.h>
#include <sys/stat.h>

namespace lacuna::cad_worker {

using cad_protocol::MakeSolidRequest;

namespace {

/// Allowed relative change of the volume when the file is read back: readers of STEP recompute edges on
/// fitted surfaces.
constexpr double kVolumeChange = 1e-4;

/// Whether a curve of a face is degenerate: the pole of a sphere, the tip of a cone.
bool is_pole(int curve, double diagonal) { return mass_of(1, curve) <= kSamePlace * diagonal; }

/// How the current model differs from one closed solid, as text; empty if it does not differ.
std::string faults_of_model(double diagonal)
{
    gmsh::model::occ::synchronize();
    const std::vector<int> solids = tags_of(3);
    if (solids.size() != 1) return formatted("{} solids", solids.size());
    const gmsh::vectorpair faces = boundary_of({{3, solids.front()}});
    if (faces.size() != tags_of(2).size())
        return formatted("{} faces outside the solid", tags_of(2).size() - faces.size());
    std::map<int, int> uses;
    for (const auto& face : faces)
        for (const auto& curve : boundary_of({{2, std::abs(face.second)}})) ++uses[std::abs(curve.second)];
    std::size_t open = 0;
    for (const auto& [curve, count] : uses) open += count == 2 || is_pole(curve, diagonal) ? 0 : 1;
    return open == 0 ? "" : formatted("{} open edges", open);
}

/// Divide a box, which encloses the faces, by the faces. @return the part that is bounded by exactly these
/// faces; 0 if there is none.
///
/// Sewing removes the zero-length edges at poles and tips, after which Open CASCADE reports the faces there
/// as invalid. Cutting keeps these edges but takes longer.
int cut_out(Session& session, const gmsh::vectorpair& shapes, const MakeSolidRequest& request,
            double tolerance)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& p : request.points) box.extend(p);
    // The box is so large that faces that bulge between their points stay inside.
    const Vec3 side = 3 * box.diagonal().norm() * Vec3::Ones(), low = box.center() - side / 2;
    const int around = gmsh::model::occ::addBox(low.x(), low.y(), low.z(), side.x(), side.y(), side.z());
    session.set("Geometry.ToleranceBoolean", tolerance);
    gmsh::vectorpair own, out; // copies, because faces that stay as they are become part of the result
    gmsh::model::occ::copy(shapes, own);
    std::vector<gmsh::vectorpair> map;
    gmsh::model::occ::fragment({{3, around}}, own, out, map);
    session.set("Geometry.ToleranceBoolean", 0.0);
    gmsh::model::occ::synchronize();
    int solid = 0;
    for (const auto& [dim, tag] : out) {
        if (dim != 3) continue;
        if (boundary_of({{dim, tag}}).size() == shapes.size() && mass_of(3, tag) > 0) solid = tag;
    }
    if (solid == 0) gmsh::model::occ::remove(out, true);
    return solid;
}

bool has_pole(int face, double diagonal)
{
    return std::ranges::any_of(boundary_of({{2, face}}),
                               [&](const auto& curve) { return is_pole(curve.second, diagonal); });
}

/// Sew with increasing tolerances until the faces form one solid. @return the solid, and the tolerance that
/// was used
std::pair<int, double> sew(Session& session, const std::vector<int>& faces, const MakeSolidRequest& request)
{
    gmsh::vectorpair shapes;
    for (const int face : faces) shapes.emplace_back(2, face);
    gmsh::model::occ::synchronize();
    const bool poles = std::any_of(faces.begin(), faces.end(),
                                   [&](int face) { return has_pole(face, request.diagonal); });
    const double last = request.last_tolerance;
    for (double tolerance = request.first_tolerance; tolerance <= last; tolerance *= 10) {
        if (poles) {
            if (const int solid = cut_out(session, shapes, request, tolerance)) return {solid, tolerance};
            continue;
        }
        gmsh::vectorpair out;
        gmsh::model::occ::healShapes(out, shapes, tolerance, false, false, false, true, true);
        std::erase_if(out, [](const auto& entity) { return entity.first != 3; });
        gmsh::model::occ::synchronize();
        if (out.size() == 1 && boundary_of(out).size() == faces.size() && mass_of(3, out.front().second) > 0)
            return {out.front().second, tolerance};
        gmsh::model::occ::remove(out);
    }
    session.refuse(Message("cad.not_sewn",
                           "the {} faces do not form one solid, even if gaps of up to {:.6g} are closed",
                           faces.size(), needed(last))
                       .remedy("use a larger 'tolerance', or write the facets with write_facets"));
}

/// Write the current model to a file and check that the file is complete. Open CASCADE may not report a
/// failed write, so the size of the file is compared with the limit.
void write_whole(const Session& session, const std::string& path)
{
    const auto check_room = [&] {
        rlimit limit{};
        struct stat file {};
        if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || ::stat(path.c_str(), &file) != 0) return;
        if (limit.rlim_cur == RLIM_INFINITY || static_cast<rlim_t>(file.st_size) < limit.rlim_cur) return;
        session.refuse(Message("cad.file_limit",
                               "the file of the solid exceeds the limit of {} bytes per file",
                               needed(limit.rlim_cur))
                           .remedy("raise the limit (ulimit -f)"));
    };
    try {
        gmsh::write(path);
    } catch (...) {
        check_room();
        throw;
    }
    check_room();
}

/// Write one solid of the current model and nothing else.
void write_alone(Session& session, int solid, const SolidFiles& files)
{
    gmsh::vectorpair others;
    for (const int tag : tags_of(3))
        if (tag != solid) others.emplace_back(3, tag);
    if (!others.empty()) gmsh::model::occ::remove(others);
    // Copy the solid through a file. Faces, curves and points that the solid does not use are dropped when it
    // is read.
    gmsh::model::occ::synchronize();
    write_whole(session, files.all);
    const GmshModel alone(session);
    set_plain_import(session, 1);
    import_shapes(files.all, "brep", true);
    write_whole(session, files.result);
}

/// Read the file back. @return number of faces and volume.
std::pair<std::size_t, double> read_back(Session& session, const MakeSolidRequest& request,
                                         const SolidFiles& files, double expected)
{
    const GmshModel again(session);
    return session.run([&] {
        set_plain_import(session, 1);
        import_shapes(files.result, request.format == MakeSolidRequest::brep ? "brep" : "step");
        const std::string faults = faults_of_model(request.diagonal);
        if (!faults.empty())
            session.refuse(
                Message("cad.reads_back", "the file reads back with {} instead of one closed solid", faults)
                    .remedy("write the facets with write_facets"));
        const double volume = mass_of(3, tags_of(3).front());
        if (!(std::abs(volume - expected) <= kVolumeChange * expected)) {
            session.refuse(
                Message("cad.reads_back",
                        "the written file encloses a volume of {:.6g} when read back, instead of {:.6g}",
                        found(volume), needed(expected))
                    .remedy("write it as .brep"));
        }
        return std::pair(tags_of(2).size(), volume);
    });
}

void check_volume(const Session& session, double volume, const MakeSolidRequest& request)
{
    if (std::abs(volume - request.facet_volume) <= request.deviation * request.facet_volume) return;
    session.refuse(
        Message("cad.volume_differs",
                "the solid has a volume of {:.6g}, but the facets enclose {:.6g}: a surface fitted "
                "to a void face bulges",
                found(volume), needed(request.facet_volume))
            .remedy("allow more with 'deviation', or write the facets with write_facets"));
}

} // namespace

cad_protocol::MakeSolidReply write_solid(Session& session, const std::vector<int>& faces,
                                         const MakeSolidRequest& request, const SolidFiles& files)
{
    const CapturedOutput output;
    const auto [solid, tolerance] = sew(session, faces, request);
    const double volume = mass_of(3, solid);
    check_volume(session, volume, request);
    write_alone(session, solid, files);
    const auto [count, written] = read_back(session, request, files, volume);
    return {written, tolerance, count};
}

} // namespace lacuna::cad_worker
