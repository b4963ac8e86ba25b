// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/write_cad.h>

#include <lacuna/cad/detail/gmsh_api.h>
#include <lacuna/cad/detail/import_cad.h>
#include <lacuna/cad/detail/solid_builder.h>
#include <lacuna/closure/close.h>
#include <lacuna/io/whole_file.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

namespace lacuna::cad {

using namespace topology;

namespace {

/// Free edges a message names before it only counts.
constexpr std::size_t kNamedEdges = 4;
/// Sewing bridges no wider gaps than this part of the diagonal: what is that far apart does not belong
/// together.
constexpr double kWidestGap = 1e-3;
/// What a file may change of the volume: STEP leaves it to the reader to lay edges on fitted surfaces anew.
constexpr double kSameVolume = 1e-4;

/// A folder for files on the way, which goes with the object.
class Workshop {
public:
    Workshop()
    {
        std::error_code error;
        std::string name = (std::filesystem::temp_directory_path(error) / "lacuna-XXXXXX").string();
        if (error || ::mkdtemp(name.data()) == nullptr)
            throw BackendError(
                "cad.no_workshop",
                "there is no folder for temporary files; set TMPDIR to one that can be written to");
        folder_ = name;
    }
    ~Workshop()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;
    [[nodiscard]] const std::string& folder() const { return folder_; }

private:
    std::string folder_;
};

void check_sealed(const OpenVolume& volume)
{
    if (closure::is_watertight(volume)) return;
    const std::vector<EdgeId> open = free_edges(volume);
    std::string which = "it encloses nothing";
    if (!open.empty()) {
        which = std::to_string(open.size()) + (open.size() == 1 ? " edge is free: " : " edges are free: ");
        for (std::size_t i = 0; i < std::min(open.size(), kNamedEdges); ++i)
            which += (i > 0 ? ", " : "") + name_of(volume.model, open[i]);
        if (open.size() > kNamedEdges) which += ", …";
    }
    throw InvalidInput("cad.not_sealed",
                       "the volume is not sealed, so it is no solid: " + which + "; close() it first");
}

std::vector<int> tags_of(int dim)
{
    gmsh::vectorpair entities;
    gmsh::model::occ::getEntities(entities, dim);
    std::vector<int> tags;
    for (const auto& entity : entities) tags.push_back(entity.second);
    return tags;
}

double volume_of(int solid)
{
    double volume = 0;
    gmsh::model::occ::getMass(3, solid, volume);
    return volume;
}

/// How many entities of the current model are not as they are in one closed solid; in words, empty where all
/// are.
std::string faults_of_model()
{
    gmsh::model::occ::synchronize();
    const std::vector<int> solids = tags_of(3);
    if (solids.size() != 1) return std::to_string(solids.size()) + " solids";
    gmsh::vectorpair faces;
    gmsh::model::getBoundary({{3, solids.front()}}, faces, false, false, false);
    if (faces.size() != tags_of(2).size())
        return std::to_string(tags_of(2).size() - faces.size()) + " faces beside the solid";
    std::map<int, int> uses;
    for (const auto& face : faces) {
        gmsh::vectorpair curves;
        gmsh::model::getBoundary({{2, std::abs(face.second)}}, curves, false, false, false);
        for (const auto& curve : curves) ++uses[std::abs(curve.second)];
    }
    std::size_t open = 0;
    for (const auto& [curve, count] : uses) open += count == 2 ? 0 : 1;
    return open == 0 ? "" : std::to_string(open) + " open edges";
}

/// A solid sewn of faces of the current model.
struct Sewn {
    int solid = 0;
    double tolerance = 0;
};

/// Sew with ever wider tolerances until one solid comes of it.
Sewn sew(const std::vector<int>& faces, const WriteCadOptions& options, const Model& model)
{
    gmsh::vectorpair shapes;
    for (const int face : faces) shapes.emplace_back(2, face);
    const double first = options.tolerance > 0 ? options.tolerance : model.tolerance;
    const double last = options.tolerance > 0 ? first : std::max(first, kWidestGap * model.diagonal);
    for (double tolerance = first; tolerance <= last; tolerance *= 10) {
        gmsh::vectorpair out;
        gmsh::model::occ::healShapes(out, shapes, tolerance, false, false, false, true, true);
        std::erase_if(out, [](const auto& entity) { return entity.first != 3; });
        gmsh::model::occ::synchronize();
        gmsh::vectorpair boundary;
        if (out.size() == 1) gmsh::model::getBoundary(out, boundary, false, false, false);
        if (boundary.size() == faces.size() && volume_of(out.front().second) > 0)
            return {out.front().second, tolerance};
        gmsh::model::occ::remove(out);
    }
    throw BackendError(
        "cad.not_sewn",
        "the " + std::to_string(faces.size()) + " faces could not be sewn into one solid, with gaps up to " +
            std::to_string(last) +
            " closed; load the file with a larger tolerance, or write the facets with write_facets");
}

/// Write one solid of the current model, and nothing else there is.
void write_alone(Session& session, int solid, const std::string& folder, const std::string& file)
{
    gmsh::vectorpair others;
    for (const int tag : tags_of(3))
        if (tag != solid) others.emplace_back(3, tag);
    if (!others.empty()) gmsh::model::occ::remove(others);
    // Faces, curves and points are many; read on from a file, the solid comes without those that are not its
    // own.
    const std::string all = folder + "/all.brep";
    gmsh::model::occ::synchronize();
    gmsh::write(all);
    const GmshModel alone(session);
    set_plain_import(session, 1);
    gmsh::vectorpair found;
    gmsh::model::occ::importShapes(all, found, true, "brep");
    gmsh::model::occ::synchronize();
    gmsh::write(file);
}

/// A STEP file's head without the time it was written at.
void forget_time(std::string& bytes)
{
    const std::size_t name = std::min(bytes.find("FILE_NAME("), bytes.size());
    const std::size_t end = std::min(bytes.find(';', name), bytes.size());
    constexpr std::string_view kShape = "0000-00-00T00:00:00";
    for (std::size_t at = name; at + kShape.size() < end; ++at) {
        const auto fits = [&](std::size_t i) {
            const char c = bytes[at + i];
            return kShape[i] == '0' ? c >= '0' && c <= '9' : c == kShape[i];
        };
        std::size_t i = 0;
        while (i < kShape.size() && fits(i)) ++i;
        if (i < kShape.size()) continue;
        bytes.replace(at, kShape.size(), "1970-01-01T00:00:00");
        return;
    }
}

/// The bytes of a file; of a STEP file what they are every time: Open CASCADE notes when it wrote it, and
/// names the product by how many it has written.
std::string bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (io::ending_of(path) == ".brep") return bytes;
    forget_time(bytes);
    constexpr std::string_view kCounted = "'Open CASCADE STEP translator ";
    for (std::size_t at = bytes.find(kCounted); at != std::string::npos; at = bytes.find(kCounted, at + 1))
        bytes.replace(at, bytes.find('\'', at + 1) + 1 - at, "'volume'");
    return bytes;
}

/// Read back what was written. @return number of faces and volume.
std::pair<std::size_t, double> read_back(Session& session, const std::string& file, double expected)
{
    const GmshModel again(session);
    return session.run([&] {
        set_plain_import(session, 1);
        gmsh::vectorpair all;
        gmsh::model::occ::importShapes(file, all, false, io::ending_of(file) == ".brep" ? "brep" : "step");
        const std::string faults = faults_of_model();
        if (!faults.empty())
            throw BackendError("cad.reads_back",
                               "the solid reads back with " + faults +
                                   ", not as one closed solid; write the facets with write_facets");
        const double volume = volume_of(tags_of(3).front());
        if (!(std::abs(volume - expected) <= kSameVolume * expected)) {
            throw BackendError("cad.reads_back", "the solid reads back with a volume of " +
                                                     std::to_string(volume) + ", not " +
                                                     std::to_string(expected) +
                                                     "; check the unit Gmsh's host has set for STEP files");
        }
        return std::pair(tags_of(2).size(), volume);
    });
}

void check_volume(const WrittenCad& written, const WriteCadOptions& options)
{
    if (std::abs(written.volume - written.facet_volume) <= options.deviation * written.facet_volume) return;
    throw BackendError("cad.volume_differs", "the solid has a volume of " + std::to_string(written.volume) +
                                                 ", but the facets enclose " +
                                                 std::to_string(written.facet_volume) +
                                                 ": the surfaces fitted to void faces bulge; give more "
                                                 "walls, or write the facets with write_facets");
}

void check_options(const WriteCadOptions& options)
{
    if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
        throw InvalidInput("cad.tolerance", "the tolerance must be a length of 0 or more, not " +
                                                std::to_string(options.tolerance));
    if (!(options.deviation > 0))
        throw InvalidInput("cad.deviation", "the deviation must be a number above 0, not " +
                                                std::to_string(options.deviation));
}

} // namespace

WrittenCad write_cad(const OpenVolume& volume, const io::OutputPath& path, const WriteCadOptions& options,
                     const RunContext& context)
{
    check_options(options);
    const std::string ending = io::ending_of(path.text());
    if (ending != ".step" && ending != ".stp" && ending != ".brep") {
        throw InvalidInput("cad.unknown_ending",
                           "cannot write a solid to '" + path.text() + "': the ending \"" + ending +
                               "\" says no format; solids are written as .step, .stp and .brep");
    }
    check_sealed(volume);
    io::WholeFile file(path);
    const Workshop workshop;
    const std::string unfinished = workshop.folder() + "/solid" + ending;
    WrittenCad written;
    written.facet_volume = closure::enclosed_volume(volume);

    Session session(path.text());
    const GmshModel scratch(session);
    const CapturedOutput output;
    SolidBuilder builder(session, scratch, volume, workshop.folder());
    const SolidBuilder::Built built = builder.build(context);
    written.planes = built.planes;
    written.fitted = built.fitted;
    check_cancelled(context);
    scratch.activate(session);
    session.run([&] {
        const Sewn sewn = sew(built.faces, options, volume.model);
        written.tolerance = sewn.tolerance;
        written.volume = volume_of(sewn.solid);
        check_volume(written, options);
        write_alone(session, sewn.solid, workshop.folder(), unfinished);
    });
    check_cancelled(context);
    std::tie(written.faces, written.volume) = read_back(session, unfinished, written.volume);
    file.append(bytes_of(unfinished));
    file.commit();
    return written;
}

} // namespace lacuna::cad
