// SPDX-License-Identifier: MIT
//
// libmedC is loaded only when a file is read or written. It runs in a process of its own, because HDF5, which
// it uses, crashes on damaged files.
#include <lacuna/io/detail/med.h>

#include <lacuna/core/error.h>

#ifdef LACUNA_MED

#include <lacuna/core/shared/bytes.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/inflate.h>

#include <csignal>
#include <optional>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

// The header needs these types of MPI for a function that is not used here.
using MPI_Comm = void*;
using MPI_Info = void*;
#include <med.h>

namespace lacuna::io {
namespace {

constexpr char kMesh[] = "mesh";

/// Functions of the library, which only the other process loads.
class Library {
public:
    Library() : handle_(::dlopen(LACUNA_MED, RTLD_NOW)) {}
    [[nodiscard]] bool is_there() const { return handle_ != nullptr; }
    template <class Function>
    Function* get(const char* name) const
    {
        return reinterpret_cast<Function*>(::dlsym(handle_, name));
    }

private:
    void* handle_;
};
/// A function of the library that the variable `library` holds.
#define FROM_LIBRARY(name) (*library.get<decltype(name)>(#name))

/// Run `work` in another process. @return  the result of `work`; empty if the process crashed or took too
/// long
template <class Work>
std::string in_other_process(std::uint64_t bytes, const Work& work)
{
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw BackendError("io.no_process", "no pipe can be opened");
    const pid_t child = ::fork();
    if (child < 0) {
        for (const int end : ends) ::close(end);
        throw BackendError("io.no_process", "no process can be started");
    }
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        // Time limit: ten seconds, plus one for each million bytes, for which libmedC takes 0.02 s on the
        // test machine. Elapsed time is limited, because the process would wait forever for a lock that
        // another thread of the host held at fork().
        sigset_t alarm_alone;
        ::sigemptyset(&alarm_alone);
        ::sigaddset(&alarm_alone, SIGALRM);
        ::signal(SIGALRM, SIG_DFL);
        ::sigprocmask(SIG_UNBLOCK, &alarm_alone, nullptr);
        ::alarm(static_cast<unsigned>(10 + bytes / 1'000'000));
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        const int nowhere = ::open("/dev/null", O_WRONLY); // the library prints every error
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
        std::string result;
        try {
            result = work();
        } catch (...) {
            ::_exit(1); // the host's exception handlers must not run in this process
        }
        for (std::size_t done = 0; done < result.size();) {
            const ssize_t now = ::write(ends[1], result.data() + done, result.size() - done);
            if (now <= 0) ::_exit(1);
            done += static_cast<std::size_t>(now);
        }
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string result;
    std::vector<char> room(1 << 16);
    for (ssize_t now; (now = ::read(ends[0], room.data(), room.size())) != 0;) {
        if (now > 0) result.append(room.data(), static_cast<std::size_t>(now));
        if (now < 0 && errno != EINTR) break;
    }
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? result : std::string();
}

template <class Value>
std::string bytes_of(const Value& value)
{
    Writer writer;
    writer(value);
    return std::move(writer).take();
}

/// Text of a fixed length, without blanks and zeros at its end.
std::string text_of_field(const char* text, std::size_t length)
{
    const std::string_view all(text, length);
    return std::string(trimmed(all.substr(0, all.find('\0'))));
}

MedContent content_of(const Library& library, std::string_view bytes)
{
    MedContent content;
    const auto refuse = [&](std::string why) {
        content.error = std::move(why);
        return content;
    };
    std::string copy(bytes);
    med_memfile image = MED_MEMFILE_INIT;
    image.app_image_ptr = copy.data();
    image.app_image_size = copy.size();
    const med_idt file = FROM_LIBRARY(MEDmemFileOpen)("file.med", &image, MED_FALSE, MED_ACC_RDONLY);
    if (file < 0) return refuse("it is no MED file");
    const med_int meshes = FROM_LIBRARY(MEDnMesh)(file);
    if (meshes < 1) return refuse("it holds no mesh");
    if (meshes > 1) content.notes.push_back(formatted("the first of {} meshes is read", meshes));
    const med_int axes = FROM_LIBRARY(MEDmeshnAxis)(file, 1);
    if (axes < 2 || axes > 3) return refuse("its mesh does not have two or three dimensions");
    char name[MED_NAME_SIZE + 1] = {}, text[MED_COMMENT_SIZE + 1] = {}, time[MED_SNAME_SIZE + 1] = {};
    char axis[3 * MED_SNAME_SIZE + 1] = {}, unit[3 * MED_SNAME_SIZE + 1] = {};
    med_int space = 0, dimension = 0, steps = 0;
    med_mesh_type type = MED_UNDEF_MESH_TYPE;
    med_sorting_type sorting = MED_SORT_UNDEF;
    med_axis_type frame = MED_UNDEF_AXIS_TYPE;
    if (FROM_LIBRARY(MEDmeshInfo)(file, 1, name, &space, &dimension, &type, text, time, &sorting, &steps,
                                  &frame, axis, unit) < 0)
        return refuse("its mesh cannot be read");
    if (type != MED_UNSTRUCTURED_MESH || frame != MED_CARTESIAN)
        return refuse("its mesh is structured or not in Cartesian coordinates");
    content.unit = text_of_field(unit, MED_SNAME_SIZE);
    med_int step = MED_NO_DT, iteration = MED_NO_IT;
    med_float at = 0;
    if (steps > 0) FROM_LIBRARY(MEDmeshComputationStepInfo)(file, name, 1, &step, &iteration, &at);
    const auto count_of = [&](med_entity_type entity, med_geometry_type shape, med_data_type data) {
        med_bool changed = MED_FALSE, moved = MED_FALSE;
        const auto mode = data == MED_CONNECTIVITY ? MED_NODAL : MED_NO_CMODE;
        const med_int count = FROM_LIBRARY(MEDmeshnEntity)(file, name, step, iteration, entity, shape, data,
                                                           mode, &changed, &moved);
        return count > 0 ? static_cast<std::uint64_t>(count) : 0;
    };
    const auto is_too_many = [&](std::uint64_t values) { return values > kDeflateRatio * bytes.size(); };
    const auto read_numbers = [&](med_entity_type entity, med_geometry_type shape, std::uint64_t count,
                                  std::vector<std::int32_t>& families, std::vector<std::int32_t>& numbers) {
        families.assign(count, 0);
        if (count_of(entity, shape, MED_FAMILY_NUMBER) == count) FROM_LIBRARY(MEDmeshEntityFamilyNumberRd)
        (file, name, step, iteration, entity, shape, families.data());
        if (count_of(entity, shape, MED_NUMBER) != count) return;
        numbers.resize(count);
        FROM_LIBRARY(MEDmeshEntityNumberRd)
        (file, name, step, iteration, entity, shape, numbers.data());
    };
    const std::uint64_t nodes = count_of(MED_NODE, MED_NONE, MED_COORDINATE);
    if (nodes == 0 || is_too_many(nodes * static_cast<std::uint64_t>(axes)))
        return refuse("its mesh has no nodes");
    std::vector<double> coordinates(nodes * static_cast<std::uint64_t>(axes));
    if (FROM_LIBRARY(MEDmeshNodeCoordinateRd)(file, name, step, iteration, MED_FULL_INTERLACE,
                                              coordinates.data()) < 0)
        return refuse("its nodes cannot be read");
    content.points.assign(nodes, Vec3::Zero());
    for (std::size_t k = 0; k < coordinates.size(); ++k)
        content.points[k / static_cast<std::size_t>(axes)][static_cast<Index>(k) % axes] = coordinates[k];
    read_numbers(MED_NODE, MED_NONE, nodes, content.point_families, content.point_numbers);
    for (const ShapeWords& words : kShapeWords) {
        const med_geometry_type shape = words.med;
        const std::uint64_t count = shape == 0 ? 0 : count_of(MED_CELL, shape, MED_CONNECTIVITY);
        const auto size = static_cast<std::uint64_t>(shape % 100);
        if (count == 0) continue;
        if (is_too_many(count * size)) return refuse("it announces more cells than it can hold");
        MedCells& cells = content.cells.emplace_back(MedCells{.type = shape});
        cells.nodes.resize(count * size);
        if (FROM_LIBRARY(MEDmeshElementConnectivityRd)(file, name, step, iteration, MED_CELL, shape,
                                                       MED_NODAL, MED_FULL_INTERLACE, cells.nodes.data()) < 0)
            return refuse("its cells cannot be read");
        read_numbers(MED_CELL, shape, count, cells.families, cells.numbers);
    }
    for (const auto& [other, what] : {std::pair(MED_PENTA18, "wedges of 18 nodes"),
                                      {MED_TRIA7, "triangles of 7 nodes"},
                                      {MED_POLYGON, "polygons"},
                                      {MED_POLYHEDRON, "polyhedra"}})
        if (count_of(MED_CELL, other, other < MED_POLYGON ? MED_CONNECTIVITY : MED_INDEX_NODE) > 0)
            content.notes.push_back(formatted("{} are not read", what));
    const med_int families = FROM_LIBRARY(MEDnFamily)(file, name);
    for (med_int f = 1; f <= families; ++f) {
        const med_int groups = FROM_LIBRARY(MEDnFamilyGroup)(file, name, f);
        if (groups < 1) continue;
        if (is_too_many(static_cast<std::uint64_t>(groups) * MED_LNAME_SIZE))
            return refuse("it announces more groups than it can hold");
        std::string names(static_cast<std::size_t>(groups) * MED_LNAME_SIZE + 1, '\0');
        char family[MED_NAME_SIZE + 1] = {};
        MedFamily own;
        if (FROM_LIBRARY(MEDfamilyInfo)(file, name, f, family, &own.number, names.data()) < 0)
            return refuse("its groups cannot be read");
        for (std::size_t g = 0; g < static_cast<std::size_t>(groups); ++g)
            add_once(own.groups, text_of_field(names.data() + g * MED_LNAME_SIZE, MED_LNAME_SIZE));
        content.families.push_back(std::move(own));
    }
    return content;
}

struct Image {
    std::string error{}, bytes{};
};

Image image_of(const Library& library, const MedContent& content)
{
    Image image;
    const auto check = [&](med_err result, const char* what) {
        if (result < 0 && image.error.empty()) image.error = what;
    };
    med_memfile memory = MED_MEMFILE_INIT;
    const med_idt file = FROM_LIBRARY(MEDmemFileOpen)("file.med", &memory, MED_FALSE, MED_ACC_CREAT);
    const auto padded = [](std::string text, std::size_t length) {
        text.resize(length, ' ');
        return text;
    };
    std::string axes, units;
    for (const char* axis : {"x", "y", "z"}) {
        axes += padded(axis, MED_SNAME_SIZE);
        units += padded(content.unit, MED_SNAME_SIZE);
    }
    check(FROM_LIBRARY(MEDmeshCr)(file, kMesh, 3, 3, MED_UNSTRUCTURED_MESH, "", "", MED_SORT_DTIT,
                                  MED_CARTESIAN, axes.c_str(), units.c_str()),
          "mesh");
    const auto write_numbers = [&](med_entity_type entity, med_geometry_type type,
                                   const std::vector<std::int32_t>& families,
                                   const std::vector<std::int32_t>& numbers) {
        check(FROM_LIBRARY(MEDmeshEntityFamilyNumberWr)(file, kMesh, MED_NO_DT, MED_NO_IT, entity, type,
                                                        static_cast<med_int>(families.size()),
                                                        families.data()),
              "families");
        if (numbers.empty()) return;
        check(FROM_LIBRARY(MEDmeshEntityNumberWr)(file, kMesh, MED_NO_DT, MED_NO_IT, entity, type,
                                                  static_cast<med_int>(numbers.size()), numbers.data()),
              "numbers");
    };
    check(FROM_LIBRARY(MEDmeshNodeCoordinateWr)(
              file, kMesh, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_FULL_INTERLACE,
              static_cast<med_int>(content.points.size()), content.points.front().data()),
          "nodes");
    write_numbers(MED_NODE, MED_NONE, content.point_families, content.point_numbers);
    for (const MedCells& cells : content.cells) {
        if (cells.families.empty()) continue;
        check(FROM_LIBRARY(MEDmeshElementConnectivityWr)(
                  file, kMesh, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_CELL, cells.type, MED_NODAL,
                  MED_FULL_INTERLACE, static_cast<med_int>(cells.families.size()), cells.nodes.data()),
              "cells");
        write_numbers(MED_CELL, cells.type, cells.families, cells.numbers);
    }
    check(FROM_LIBRARY(MEDfamilyCr)(file, kMesh, "FAMILLE_ZERO", 0, 0, ""), "family");
    for (const MedFamily& family : content.families) {
        std::string groups;
        for (const std::string& group : family.groups) groups += padded(group, MED_LNAME_SIZE);
        const std::string name = formatted("FAM_{}", family.number);
        check(FROM_LIBRARY(MEDfamilyCr)(file, kMesh, name.c_str(), family.number,
                                        static_cast<med_int>(family.groups.size()), groups.c_str()),
              "family");
    }
    check(FROM_LIBRARY(MEDfileClose)(file), "file");
    image.bytes.assign(static_cast<const char*>(memory.app_image_ptr), memory.app_image_size);
    return image;
}

/// The result of `work(library)`, which runs in another process; empty if that process crashed or took too
/// long.
template <class Result, class Work>
std::optional<Result> from_library(std::uint64_t bytes, const Work& work)
{
    const std::string said = in_other_process(bytes, [&] {
        const Library library;
        return bytes_of(library.is_there() ? std::optional<Result>(work(library)) : std::nullopt);
    });
    std::optional<Result> result;
    if (said.empty()) return result;
    Reader reader(said);
    reader(result);
    if (!result)
        throw BackendError(
            Message("io.no_med", "the library {} that reads and writes MED is not installed", LACUNA_MED)
                .remedy("install libmedc11, or use .unv or .msh"));
    return result;
}

} // namespace

MedContent med_content(std::string_view bytes)
{
    return from_library<MedContent>(bytes.size(),
                                    [&](const Library& library) { return content_of(library, bytes); })
        .value_or(MedContent{.error = "the MED library cannot read it: the file is damaged"});
}

std::string med_bytes(MedContent& content)
{
    for (MedFamily& family : content.families)
        for (std::string& group : family.groups)
            if (group.size() > MED_LNAME_SIZE) {
                content.notes.push_back(formatted("{} is called {}", group, group.substr(0, MED_LNAME_SIZE)));
                group.resize(MED_LNAME_SIZE);
            }
    const auto image = from_library<Image>(content.points.size() * sizeof(Vec3), [&](const Library& library) {
        return image_of(library, content);
    });
    if (image && image->error.empty()) return image->bytes;
    throw BackendError(
        Message("io.med_library", "the MED library cannot write the {}", image ? image->error : "file")
            .remedy("check the installation of libmedC, or write another format"));
}

} // namespace lacuna::io

#else

namespace lacuna::io {
namespace {

[[noreturn]] void tell_no_library()
{
    throw BackendError(Message("io.no_med", "this build does not read or write MED")
                           .remedy("configure it with -DLACUNA_MED=ON, or use .unv or .msh"));
}

} // namespace

MedContent med_content(std::string_view /*bytes*/) { tell_no_library(); }

std::string med_bytes(MedContent& /*content*/) { tell_no_library(); }

} // namespace lacuna::io

#endif
