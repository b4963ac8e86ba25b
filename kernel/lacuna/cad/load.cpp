// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/load.h>

#include <lacuna/cad/import_cad.h>
#include <lacuna/core/error.h>

#include <cmath>
#include <filesystem>

namespace lacuna::cad {

namespace {

constexpr std::string_view kKnownEndings =
    ".step .stp .iges .igs .brep .geo .geo_unrolled";

void check_file(const std::string& path)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
        throw InvalidInput("cad.missing_file", "there is no file " + path + "; check the name and the folder");
    }
    if (fs::is_directory(path, ignored)) {
        throw InvalidInput("cad.is_directory", path + " is a folder; name a file in it");
    }
    if (!is_cad_ending(ending_of(path))) {
        throw InvalidInput("cad.unknown_ending", path + ": the ending \"" + ending_of(path) +
                                                     "\" is unknown; files are read that end in " + std::string(kKnownEndings));
    }
    if (fs::file_size(path, ignored) == 0) {
        throw InvalidInput("cad.empty_file", path + " is empty; export it anew");
    }
}

void check_options(const LoadOptions& options)
{
    if (!(options.scale > 0) || !std::isfinite(options.scale)) {
        throw InvalidInput("cad.scale", "the scale must be a number above 0, not " + std::to_string(options.scale));
    }
    if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance)) {
        throw InvalidInput("cad.tolerance", "the tolerance must be a length of 0 or more, not " + std::to_string(options.tolerance));
    }
}

} // namespace

topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options, const RunContext& context)
{
    check_options(options);
    if (paths.empty()) throw InvalidInput("cad.no_file", "no file was named; name at least one");
    for (const std::string& path : paths) check_file(path);
    topology::Model model = import_cad(paths, options, context);
    topology::build_loops(model);
    return model;
}

} // namespace lacuna::cad
