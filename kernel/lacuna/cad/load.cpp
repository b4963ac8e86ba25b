// SPDX-License-Identifier: MIT
#include <lacuna/cad/load.h>

#include <lacuna/cad/detail/import_cad.h>

namespace lacuna::cad {

topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options,
                     const RunContext& context, const Limits& limits)
{
    return load_files(paths, options, context, limits).model;
}

io::LoadedFiles load_files(const std::vector<std::string>& paths, const LoadOptions& options,
                           const RunContext& context, const Limits& limits)
{
    const auto import = [&](const std::vector<std::string>& cad_paths, const LoadOptions& all,
                            const RunContext& run) { return import_cad(cad_paths, all, run, limits); };
    return io::load_files(paths, options, context,
                          {".step .stp .iges .igs .brep .geo .geo_unrolled", import});
}

} // namespace lacuna::cad
