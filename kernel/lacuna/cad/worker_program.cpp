// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/worker_program.h>

#include <lacuna/core/error.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include <dlfcn.h>
#include <unistd.h>

namespace lacuna::cad {

namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "lacuna-cad";
/// Limit on the number of folders between the root of an installation and a program or library in it;
/// lib/<machine>/lua/5.4 has four.
constexpr int kMostLevels = 4;

/// Add the places of lacuna-cad that belong to a binary: its folder, and libexec/lacuna of its installation.
void add_around(const fs::path& binary, std::vector<fs::path>& places)
{
    std::error_code error;
    fs::path folder = fs::canonical(binary, error).parent_path();
    if (error) return;
    places.push_back(folder / kProgram);
    for (int level = 0; level < kMostLevels && folder.has_relative_path(); ++level) {
        folder = folder.parent_path();
        places.push_back(folder / "libexec" / "lacuna" / kProgram);
    }
}

} // namespace

std::string find_worker_program()
{
    if (const char* named = std::getenv("LACUNA_CAD"); named != nullptr && *named != '\0') {
        if (::access(named, X_OK) == 0) return named;
        throw BackendError(
            Message("cad.no_worker", "LACUNA_CAD names {}, which is not an executable file", named)
                .remedy("set LACUNA_CAD to the path of lacuna-cad, or unset it"));
    }
    std::vector<fs::path> places;
    add_around("/proc/self/exe", places);
    Dl_info here{};
    if (::dladdr(reinterpret_cast<const void*>(&find_worker_program), &here) != 0 &&
        here.dli_fname != nullptr)
        add_around(here.dli_fname, places);
#ifdef LACUNA_CAD_LIBEXEC
    places.emplace_back(LACUNA_CAD_LIBEXEC);
#endif
    for (const fs::path& place : places)
        if (::access(place.c_str(), X_OK) == 0) return place.string();
    throw BackendError(Message("cad.no_worker",
                               "the program lacuna-cad, which reads CAD files, was found neither next to "
                               "this program ({}) nor in its libexec/lacuna",
                               places.front().string())
                           .remedy("install it, or set the environment variable LACUNA_CAD to its path"));
}

} // namespace lacuna::cad
