// SPDX-License-Identifier: GPL-2.0-or-later
/// One mesh of one domain by one mesher, measured: a JSON line. against_gmsh.py beside this runs it.
///
/// usage: bench_pave DOMAIN QUADS MESHER [PICTURE]
///   DOMAIN   an outline of `test::plane_domains()` or `test::common_outlines()` by its name; saddle: a
///            curved face; FILE:FACE: a plane face of a CAD file; held:SEED:NUMBER: a member of the held
///            family; case:FILE|SOURCE|TARGET|WALLS: the source faces of a real case, by tags with commas
///   MESHER   lacuna: the paver, the numbers of sides on the outline given, as many as Gmsh gets;
///            source: as the source face of a prism, the numbers of sides the kernel's choice;
///            gmsh-8-3, gmsh-6-3, gmsh-6-s; each of Gmsh's with "+clean" and "+smooth" after it, to see what
///            they do
///   PICTURE  file for points and quads as text; of a curved face its plan

#include "gmsh_quads.h"
#include "held_family.h"
#include "plane_figures.h"
#ifdef LACUNA_WITH_CAD
#include "saddle_face.h"
#include "source_face.h"
#endif

#include <lacuna/quads/detail/clean_quads.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pave.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <random>
#include <span>
#include <stdexcept>
#include <string>

using namespace lacuna;

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bench::GmshWay way_of(const std::string& mesher)
{
    if (mesher == "gmsh-8-3") return {8, 3, false};
    if (mesher == "gmsh-6-3") return {6, 3, false};
    if (mesher == "gmsh-6-s") return {6, 0, true};
    throw std::runtime_error("no mesher is called " + mesher);
}

bench::GmshQuads make(const test::PlaneDomain& domain, const test::SeededDomain& seeded,
                      const std::string& mesher)
{
    const std::string name = mesher.substr(0, mesher.find('+'));
    if (name == "lacuna") {
        bench::GmshQuads made;
        RunContext context;
        context.threads = 1;
        const double start = seconds();
        made.mesh = quads::pave(seeded.region, {}, context).mesh;
        made.seconds = seconds() - start;
        return made;
    }
    return bench::gmsh_quads(domain, seeded, way_of(name));
}

void write_picture(const quads::PlanarQuads& mesh, const char* path)
{
    std::ofstream file(path);
    file << mesh.points.size() << ' ' << mesh.quads.size() << '\n';
    for (const Vec2& p : mesh.points) file << p.x() << ' ' << p.y() << '\n';
    for (const Quad& q : mesh.quads) file << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
}

/// @param more  JSON members that only this mesh has, each with a comma after it
void report(const char* domain, const char* mesher, const quads::PlaneQuality& q, std::size_t triangles,
            double time, const std::string& more, const std::string& fault)
{
    std::printf(
        "{\"domain\": \"%s\", \"mesher\": \"%s\", \"quads\": %zu, \"triangles\": %zu, \"seconds\": %.4f, "
        "\"min_scaled_jacobian\": %.4f, \"mean_scaled_jacobian\": %.4f, \"irregular\": %zu, "
        "\"irregular_share\": %.5f, \"boundary_irregular\": %zu, \"row_share\": %.4f, "
        "\"possible_row_share\": %.4f, \"size_share\": %.4f, \"mean_edge_ratio\": %.4f, %s\"fault\": "
        "\"%s\"}\n",
        domain, mesher, q.quads, triangles, time, q.min_scaled_jacobian, q.mean_scaled_jacobian, q.irregular,
        q.irregular_share(), q.boundary_irregular, q.row_share(), q.possible_row_share(), q.size_share(),
        q.mean_edge_ratio, more.c_str(), fault.c_str());
}

/// The JSON member of a number, with a comma after it.
std::string member(const char* name, double value)
{
    char text[64];
    std::snprintf(text, sizeof text, "\"%s\": %.4g, ", name, value);
    return text;
}

/// How symmetric nodes are, where the outline is.
std::string symmetry_members(const test::PlaneDomain& domain, std::span<const Vec2> points, double size)
{
    const std::vector<bench::Symmetry> symmetries = bench::symmetries_of(domain);
    std::string text = member("symmetries", static_cast<double>(symmetries.size()));
    if (!symmetries.empty())
        text += member("symmetry_error", bench::symmetry_error(points, symmetries) / size);
    return text;
}

#ifdef LACUNA_WITH_CAD
/// A file that is gone when this is.
class ScratchFile {
public:
    ScratchFile()
        : path_(std::filesystem::temp_directory_path() /
                ("pave_" + std::to_string(std::random_device{}()) + ".brep"))
    {
    }
    ~ScratchFile()
    {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    [[nodiscard]] std::string path() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

/// The saddle by one mesher, measured in space.
void run_saddle(double quads, const char* mesher, const char* picture)
{
    const ScratchFile file;
    const bench::SeededFace seeded = bench::saddle_face(file.path(), quads);
    const bench::SurfaceQuads made = mesher == std::string("lacuna")
                                         ? bench::lacuna_quads(seeded)
                                         : bench::gmsh_quads(seeded, way_of(mesher));
    const bench::SurfaceQuality q = bench::measure_surface(made, seeded);
    report("saddle", mesher, q.quads, made.triangles, made.seconds,
           member("least_irregular", q.least_irregular) + member("off_surface", q.off_surface), q.fault);
    if (picture == nullptr) return;
    quads::PlanarQuads plan;
    for (const Vec3& p : made.points) plan.points.emplace_back(p.x(), p.y());
    plan.quads = made.quads;
    write_picture(plan, picture);
}

/// Add up the measures of faces.
void add_to(quads::PlaneQuality& sum, const quads::PlaneQuality& q)
{
    const auto mean = [](double a, std::size_t n, double b, std::size_t m) {
        return n + m == 0 ? 1 : (a * double(n) + b * double(m)) / double(n + m);
    };
    sum.mean_scaled_jacobian = mean(sum.mean_scaled_jacobian, sum.quads, q.mean_scaled_jacobian, q.quads);
    sum.mean_edge_ratio = mean(sum.mean_edge_ratio, sum.edges, q.mean_edge_ratio, q.edges);
    sum.min_scaled_jacobian = std::min(sum.min_scaled_jacobian, q.min_scaled_jacobian);
    sum.quads += q.quads;
    sum.points += q.points;
    sum.interior += q.interior;
    sum.irregular += q.irregular;
    sum.boundary_irregular += q.boundary_irregular;
    sum.rows += q.rows;
    sum.good_rows += q.good_rows;
    sum.possible_rows += q.possible_rows;
    sum.edges += q.edges;
    sum.edges_of_size += q.edges_of_size;
}

/// Source faces in the order of the volume, measured in space.
/// @param domain  the outline, where the volume is a prism over one; else null
void run_source(const char* name, const topology::OpenVolume& volume, const test::PlaneDomain* domain,
                double quads, const char* picture)
{
    const bench::SourceQuads made = bench::mesh_source_faces(volume, quads);
    quads::PlaneQuality sum;
    int least_irregular = 0;
    std::size_t triangles = 0;
    std::string fault;
    quads::PlanarQuads plan;
    for (std::size_t i = 0; i < made.faces.size(); ++i) {
        const bench::SurfaceQuads& own = made.on_face[i];
        const bench::SurfaceQuality q = bench::measure_face(own, volume.model, made.faces[i], made.size);
        add_to(sum, q.quads);
        least_irregular += q.least_irregular;
        triangles += own.triangles;
        if (!q.fault.empty()) fault = q.fault;
        // Seen from outside.
        Vec3 normal(0, 0, 0);
        for (const Quad& quad : own.quads) {
            const auto at = [&](std::size_t k) { return own.points[index(quad[k])]; };
            normal += (at(2) - at(0)).cross(at(3) - at(1));
        }
        normal.normalize();
        const bool level = std::abs(normal.z()) > 0.99;
        const Vec3 across = level ? Vec3(1, 0, 0) : normal.unitOrthogonal(), up = normal.cross(across);
        const auto first = static_cast<Index>(plan.points.size());
        for (const Vec3& p : own.points) plan.points.emplace_back(p.dot(across), p.dot(up));
        for (Quad quad : own.quads) {
            for (Index& p : quad) p += first;
            plan.quads.push_back(quad);
        }
    }
    std::string more = "\"how\": \"" + made.how + "\", ";
    if (domain != nullptr) {
        least_irregular = bench::least_irregular(*domain);
        for (Vec2& p : plan.points) p.y() = -p.y(); // the source looks down
        more += symmetry_members(*domain, plan.points, made.size);
        for (Quad& quad : plan.quads) std::reverse(quad.begin(), quad.end());
    }
    more += member("least_irregular", least_irregular);
    report(name, "source", sum, triangles, made.seconds, more, fault);
    if (picture != nullptr) write_picture(plan, picture);
}
#endif

test::PlaneDomain domain_of(const std::string& name)
{
    const auto colon = name.rfind(':');
    if (colon == std::string::npos) return test::plane_domain(name);
    const int number = std::stoi(name.substr(colon + 1));
    if (name.starts_with("held:"))
        return bench::held_domain(static_cast<std::uint32_t>(std::stoul(name.substr(5))), number);
    return bench::face_domain(name.substr(0, colon), number);
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 4) {
        std::fprintf(stderr, "usage: bench_pave DOMAIN QUADS MESHER [PICTURE]\n");
        return 2;
    }
    const std::string name = argv[1], mesher = argv[3];
    const char* picture = argc > 4 ? argv[4] : nullptr;
    const double quads = std::stod(argv[2]);
#ifdef LACUNA_WITH_CAD
    if (name == "saddle") {
        run_saddle(quads, argv[3], picture);
        return 0;
    }
    if (name.starts_with("case:")) {
        run_source(argv[1], bench::real_case(name.substr(5)), nullptr, quads, picture);
        return 0;
    }
    if (mesher == "source") {
        const ScratchFile file;
        const test::PlaneDomain domain = domain_of(name);
        run_source(argv[1], bench::prism_over(domain, file.path()), &domain, quads, picture);
        return 0;
    }
#endif
    const test::PlaneDomain domain = domain_of(name);
    const test::SeededDomain seeded = test::seed_domain(domain, quads);
    bench::GmshQuads made = make(domain, seeded, mesher);
    const double start = seconds();
    if (mesher.find("+clean") != std::string::npos) {
        const std::size_t before = quads::measure_plane(made.mesh, seeded.region).irregular;
        quads::clean_quads(made.mesh, seeded.region.points.size(), {.size = seeded.region.size});
        std::fprintf(stderr, "%zu irregular -> %zu, %.3f s\n", before,
                     quads::measure_plane(made.mesh, seeded.region).irregular, seconds() - start);
    }
    if (mesher.find("+smooth") != std::string::npos) {
        const double before = seconds();
        quads::smooth_plane(made.mesh.points, made.mesh.quads, seeded.region.points.size(),
                            {.size = seeded.region.size});
        std::fprintf(stderr, "smoothed in %.3f s\n", seconds() - before);
    }
    made.seconds += seconds() - start;
    const std::string more = member("least_irregular", bench::least_irregular(domain)) +
                             symmetry_members(domain, made.mesh.points, seeded.size);
    report(argv[1], argv[3], quads::measure_plane(made.mesh, seeded.region), made.triangles, made.seconds,
           more, quads::find_fault(made.mesh, seeded.region));
    if (picture != nullptr) write_picture(made.mesh, picture);
    return 0;
} catch (const std::string& error) { // Gmsh 4.8 throws text
    std::fprintf(stderr, "%s\n", error.c_str());
    return 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
