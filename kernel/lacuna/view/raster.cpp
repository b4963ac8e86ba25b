// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/raster.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/geometry/shared/segment.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::view {

namespace {

constexpr int kSamples = 3;      // samples per pixel, in each direction
constexpr double kMargin = 0.05; // free margin, relative to the picture
constexpr double kFront = -2;    // depth in front of everything else
constexpr Colour kLineColour{60, 66, 74};

/// A parallel projection of the scene to sample coordinates; depth increases away from the viewer.
class Projection {
public:
    Projection(const Scene& scene, const PictureOptions& options, const PlacedLegend& legend)
    {
        const Vec3 back = options.direction.normalized();
        const Vec3 up = std::abs(back.z()) > 0.98 ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ());
        const Vec3 right = up.cross(back).normalized();
        turn_.row(0) = right;
        turn_.row(1) = back.cross(right);
        turn_.row(2) = back;
        Eigen::AlignedBox3d box;
        for (const DrawnSide& side : scene.sides)
            for (std::size_t k = 0; k < side.count; ++k) box.extend(turn_ * side.corner[k]);
        // If title and legend leave less height than they take, they are drawn over the object, which gets
        // the full height.
        const double words = legend.above + legend.below, room = options.height - words;
        const bool beside = room > words;
        const double width = options.width * kSamples;
        const double height = (beside ? room : options.height) * kSamples;
        const Vec3 size = box.sizes();
        scale_ = std::min(width * (1 - 2 * kMargin) / std::max(size.x(), 1e-300),
                          height * (1 - 2 * kMargin) / std::max(size.y(), 1e-300));
        middle_ = box.center();
        shift_ = {width / 2, (beside ? legend.above * kSamples : 0) + height / 2};
        depth_ = std::max(size.norm(), 1e-300);
    }
    /// x to the right, y down [samples]; z away from the viewer, relative to the size of the object.
    [[nodiscard]] Vec3 operator()(const Vec3& place) const
    {
        const Vec3 seen = turn_ * place - middle_;
        return {shift_.x() + seen.x() * scale_, shift_.y() - seen.y() * scale_, -seen.z() / depth_};
    }
    [[nodiscard]] Vec3 turned(const Vec3& direction) const { return turn_ * direction; }

private:
    Eigen::Matrix3d turn_;
    Vec3 middle_;
    Vec2 shift_;
    double scale_ = 1, depth_ = 1;
};

/// A side in sample coordinates.
struct Placed {
    std::array<Vec3, 4> corner; ///< projected
    std::size_t count;
    unsigned hidden;
    Colour colour; ///< after lighting
    bool hatched;
    double line; ///< darkness of its lines; less if they would cover the side
    Vec2 low, high;
};

/// Brightness of a cell face with this normal; the light comes from behind the viewer's left shoulder.
double light_on(const Vec3& normal)
{
    const Vec3 seen = normal.z() < 0 ? Vec3(-normal) : normal;
    static const Vec3 kLight = Vec3(-0.25, 0.45, 0.86).normalized();
    return 0.52 + 0.40 * std::max(seen.dot(kLight), 0.0) + 0.10 * seen.z();
}

std::vector<Placed> place_sides(const Scene& scene, const Projection& project)
{
    std::vector<Placed> placed;
    placed.reserve(scene.sides.size());
    for (const DrawnSide& side : scene.sides) {
        const Vec3 across = side.corner[2] - side.corner[0];
        const Vec3 normal = side.count == 3 ? Vec3((side.corner[1] - side.corner[0]).cross(across))
                                            : Vec3(across.cross(side.corner[3] - side.corner[1]));
        const double area = normal.norm();
        if (!(area > 0)) continue;
        const Vec3 seen = project.turned(normal / area);
        if (side.closed && seen.z() <= 0 && side.count == 3) continue;
        Placed& own = placed.emplace_back();
        own.count = side.count;
        own.hidden = side.hidden;
        own.hatched = side.hatched;
        const double light = std::min(light_on(seen) * (!side.closed && seen.z() < 0 ? 0.72 : 1.0), 1.0);
        own.colour = mixed({0, 0, 0}, side.colour, light);
        own.low = Vec2::Constant(kInfinity);
        own.high = -own.low;
        double girth = 0;
        for (std::size_t k = 0; k < side.count; ++k) {
            own.corner[k] = project(side.corner[k]);
            own.low = own.low.cwiseMin(own.corner[k].head<2>());
            own.high = own.high.cwiseMax(own.corner[k].head<2>());
        }
        for (std::size_t k = 0; k < side.count; ++k)
            girth += (own.corner[(k + 1) % side.count] - own.corner[k]).head<2>().norm();
        // On quads a few pixels wide, lines are fainter; on quads below two pixels, there are none.
        const double width = girth / static_cast<double>(side.count) / kSamples;
        own.line = std::clamp((width - 2) / 4, 0.0, 1.0);
    }
    return placed;
}

/// The samples of a band of rows.
class Band {
public:
    Band(int width, int first, int rows) : width_(width), first_(first), rows_(rows)
    {
        const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
        depth_.assign(count, std::numeric_limits<float>::infinity());
        colour_.assign(count, Colour{255, 255, 255});
    }

    void draw(const Placed& side)
    {
        if (side.high.y() < first_ || side.low.y() > first_ + rows_) return;
        fill(side, {0, 1, 2});
        if (side.count == 4) fill(side, {0, 2, 3});
    }

    void draw(const Vec3& from, const Vec3& to, const Colour& colour, double half_width)
    {
        const Vec2 a = from.head<2>(), b = to.head<2>();
        const Vec2 low = a.cwiseMin(b).array() - half_width, high = a.cwiseMax(b).array() + half_width;
        const double length = (b - a).squaredNorm();
        each(low, high, [&](const Vec2& at, std::size_t sample) {
            const double t = length > 0 ? std::clamp((at - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
            if ((at - a - t * (b - a)).norm() > half_width) return;
            put(sample, from.z() + t * (to.z() - from.z()) - kVisible, colour); // in front of its faces
        });
    }

    /// Draw a rectangle in front of the scene and of earlier rectangles.
    void draw(const Vec2& low, const Vec2& high, const Colour& colour, bool hatched)
    {
        each(low, high, [&](const Vec2& at, std::size_t sample) {
            depth_[sample] = static_cast<float>(kFront);
            colour_[sample] = hatched && on_stripe(at) ? mixed({0, 0, 0}, colour, kStriped) : colour;
        });
    }

    /// Average the samples of each pixel into the picture.
    void resolve(Image& image) const
    {
        const int wide = width_ / kSamples;
        for (int y = 0; y < rows_ / kSamples; ++y) {
            for (int x = 0; x < wide; ++x) {
                std::array<int, 3> sum{};
                for (int j = 0; j < kSamples; ++j)
                    for (int i = 0; i < kSamples; ++i)
                        for (std::size_t k = 0; k < 3; ++k)
                            sum[k] += colour_[place(x * kSamples + i, y * kSamples + j)][k];
                const auto at = 3 * (static_cast<std::size_t>(first_ / kSamples + y) *
                                         static_cast<std::size_t>(wide) +
                                     static_cast<std::size_t>(x));
                for (std::size_t k = 0; k < 3; ++k)
                    image.rgb[at + k] = static_cast<std::uint8_t>((sum[k] + kSamples * kSamples / 2) /
                                                                  (kSamples * kSamples));
            }
        }
    }

private:
    [[nodiscard]] std::size_t place(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    /// Call visit(coordinates, number) for the samples in a box.
    template <class Visit>
    void each(const Vec2& low, const Vec2& high, Visit&& visit) const
    {
        const int left = std::max(0, static_cast<int>(std::ceil(std::max(low.x(), 0.0) - 0.5)));
        const int right = static_cast<int>(std::floor(std::min(high.x(), double(width_)) - 0.5));
        const int top = std::max(first_, static_cast<int>(std::ceil(std::max(low.y(), 0.0) - 0.5)));
        const int bottom = static_cast<int>(std::floor(std::min(high.y(), double(first_ + rows_)) - 0.5));
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) visit(Vec2(x + 0.5, y + 0.5), place(x, y - first_));
    }

    void fill(const Placed& side, const std::array<std::size_t, 3>& corners)
    {
        const Vec3 &a = side.corner[corners[0]], &b = side.corner[corners[1]], &c = side.corner[corners[2]];
        const Vec2 ab = (b - a).head<2>(), ac = (c - a).head<2>();
        const double twice = ab.x() * ac.y() - ab.y() * ac.x();
        if (twice == 0) return;
        const Vec2 low = a.head<2>().cwiseMin(b.head<2>()).cwiseMin(c.head<2>());
        const Vec2 high = a.head<2>().cwiseMax(b.head<2>()).cwiseMax(c.head<2>());
        each(low, high, [&](const Vec2& at, std::size_t sample) {
            const Vec2 p = at - a.head<2>();
            const double v = (p.x() * ac.y() - p.y() * ac.x()) / twice;
            const double w = (ab.x() * p.y() - ab.y() * p.x()) / twice;
            if (v < 0 || w < 0 || v + w > 1) return;
            const double depth = a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z());
            if (depth < depth_[sample]) put(sample, depth, colour_at(side, at));
        });
    }

    static constexpr double kStriped = 0.7; // brightness of a stripe
    [[nodiscard]] static bool on_stripe(const Vec2& at)
    {
        constexpr double kHatch = 9 * kSamples, kStripe = 2 * kSamples; // [samples]
        return std::fmod(at.x() + at.y(), kHatch) < kStripe;
    }

    [[nodiscard]] static Colour colour_at(const Placed& side, const Vec2& at)
    {
        Colour colour = side.colour;
        if (side.hatched && on_stripe(at)) colour = mixed({0, 0, 0}, colour, kStriped);
        if (side.line <= 0) return colour;
        for (std::size_t k = 0; k < side.count; ++k) {
            if ((side.hidden >> k & 1U) != 0) continue;
            const Vec2 from = side.corner[k].head<2>(), to = side.corner[(k + 1) % side.count].head<2>();
            if (geometry::distance_to_segment(at, from, to) < kSamples / 2.0) // a line is a pixel wide
                return mixed(colour, kLineColour, side.line);
        }
        return colour;
    }

    void put(std::size_t sample, double depth, const Colour& colour)
    {
        if (!(depth < depth_[sample])) return;
        depth_[sample] = static_cast<float>(depth);
        colour_[sample] = colour;
    }

    int width_, first_, rows_;
    std::vector<float> depth_;
    std::vector<Colour> colour_;
};

/// Draw the legend in front of everything else.
void draw_marks(Band& band, const std::vector<Mark>& marks)
{
    for (const Mark& mark : marks) {
        const Vec2 from = mark.from * kSamples, to = mark.to * kSamples;
        if (mark.width > 0)
            band.draw({from.x(), from.y(), kFront}, {to.x(), to.y(), kFront}, mark.colour,
                      mark.width * kSamples / 2);
        else
            band.draw(from, to, mark.colour, mark.hatched);
    }
}

void check(const PictureOptions& options)
{
    constexpr int kLeast = 16,
                  kMost = 16384; // [pixels]; bounds memory: a picture is sampled one band at a time
    const std::pair<const char*, int> lengths[] = {{"width", options.width}, {"height", options.height}};
    for (const auto& [name, length] : lengths)
        if (length < kLeast || length > kMost)
            throw InvalidInput("view.picture_size",
                               "picture: option '{}' must be 16 to 16384 pixels, found {}", name,
                               found(length));
    if (!(options.direction.norm() > 0) || !options.direction.allFinite())
        throw InvalidInput("view.direction",
                           "picture: option 'direction' must be a finite vector other than zero");
    if (options.cut && (!(options.cut->normal.norm() > 0) || !options.cut->normal.allFinite()))
        throw InvalidInput("view.direction",
                           "picture: the normal of option 'cut' must be a finite vector other than zero");
}

} // namespace

Image rasterise(const Scene& scene, const PictureOptions& options, const RunContext& context)
{
    check(options);
    const PlacedLegend legend = options.legend ? place_legend(scene.legend, options.width, options.height)
                                               : PlacedLegend{};
    const Projection project(scene, options, legend);
    const std::vector<Placed> sides = place_sides(scene, project);
    Image image{options.width, options.height, {}};
    image.rgb.resize(3 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height));
    constexpr std::size_t kRows = 64; // rows of a band: its samples fit in the cache
    const std::size_t bands = (static_cast<std::size_t>(options.height) + kRows - 1) / kRows;
    parallel_each(context, bands, 1, [&](std::size_t b) {
        check_cancelled(context);
        const int first = static_cast<int>(b * kRows);
        const int rows = std::min(static_cast<int>(kRows), options.height - first);
        Band band(options.width * kSamples, first * kSamples, rows * kSamples);
        for (const Placed& side : sides) band.draw(side);
        for (const DrawnLine& line : scene.lines)
            band.draw(project(line.from), project(line.to), line.colour, line.width * kSamples / 2);
        draw_marks(band, legend.marks);
        band.resolve(image);
    });
    return image;
}

} // namespace lacuna::view
