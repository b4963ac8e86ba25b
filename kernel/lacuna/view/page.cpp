// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/page_file.h>

#include <lacuna/view/detail/base64.h>
#include <lacuna/view/detail/page_texts.h>
#include <lacuna/view/detail/palette.h>

#include <cmath>

namespace lacuna::view {

Grid grid_over(const Eigen::AlignedBox3d& box)
{
    // Graphics cards compute in single precision, with a resolution of 2^-24.
    constexpr double kSteps = 1 << 21;
    Grid grid;
    if (box.isEmpty()) return grid;
    grid.low = box.min();
    grid.centre = box.center();
    const double extent = box.sizes().maxCoeff();
    grid.step = extent > 0 ? extent / kSteps : 1;
    grid.radius = extent > 0 ? box.diagonal().norm() / 2 : 1;
    return grid;
}

void add_frame(Json& json, const Grid& grid)
{
    json.member("low", grid.low).member("centre", grid.centre);
    json.member("step", grid.step).member("radius", grid.radius);
    json.key("palette").begin_object();
    json.member("quality", kQualityRamp).member("order", kOrderRamp).member("kinds", kind_colours());
    const std::pair<const char*, Colour> single[] = {{"given", kGiven},   {"void", kVoid},
                                                     {"inside", kInside}, {"source", kSource},
                                                     {"target", kTarget}, {"walls", kWall}};
    for (const auto& [name, colour] : single) json.member(name, colour);
    json.end_object();
}

void add_nodes(Json& json, const Grid& grid, std::span<const Vec3> nodes, std::size_t stride)
{
    json.begin_object().member("count", nodes.size()).member("stride", stride);
    json.key("axes").begin_array();
    std::vector<Index> whole(nodes.size());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        for (std::size_t n = 0; n < nodes.size(); ++n)
            whole[n] = static_cast<Index>(std::lround((nodes[n][axis] - grid.low[axis]) / grid.step));
        json.value(pack(whole, stride, true));
    }
    json.end_array().end_object();
}

void write_html(const Json& data, const io::OutputPath& path)
{
    io::WholeFile file(path);
    file.append("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                "script-src 'unsafe-inline'; style-src 'unsafe-inline'\">\n"
                "<meta name=\"viewport\" content=\"width=device-width\">\n<title>Lacuna</title>\n<style>\n");
    file.append(kPage_css);
    file.append("</style>\n</head>\n<body>\n<div id=\"stage\"></div>\n<div id=\"panel\"></div>\n"
                "<script type=\"application/json\" id=\"data\">");
    file.append(data.text());
    file.append("</script>\n<script>\n");
    file.append(kPage_js);
    file.append("</script>\n</body>\n</html>\n");
    file.commit();
}

} // namespace lacuna::view
