// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/load.h>

#include <lacuna/cad/detail/import_cad.h>

namespace lacuna::cad {

topology::Model load(const std::vector<std::string>& paths, const LoadOptions& options,
                     const RunContext& context)
{
    return io::load_facets(paths, options, context,
                           {".step .stp .iges .igs .brep .geo .geo_unrolled", import_cad});
}

} // namespace lacuna::cad
