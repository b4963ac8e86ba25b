// SPDX-License-Identifier: MIT
#include <lacuna/cad/load.h>

#include <lacuna/cad/detail/import_cad.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace lacuna::cad {

topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options,
                     const RunContext& context, const Limits& limits)
{
    return load_files(paths, options, context, limits).model;
}

io::LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context, const Limits& limits)
{
    std::vector<std::string> left_out;
    RunContext telling = context; // a hole in the model is told to everybody
    if (context.log) {
        telling.log = [&](std::string_view line) {
            const bool hole = std::ranges::find(left_out, line) != left_out.end();
            context.log(hole ? "note: " + std::string(line) : std::string(line));
        };
    }
    const auto import = [&](const std::vector<std::string>& cad_paths, const LoadOptions& all,
                            const RunContext& run) {
        ImportedCad imported = import_cad(cad_paths, all, run, limits);
        left_out = std::move(imported.left_out);
        return std::move(imported.model);
    };
    return io::load_files(paths, options, telling,
                          {".step .stp .iges .igs .brep .geo .geo_unrolled", import});
}

} // namespace lacuna::cad
