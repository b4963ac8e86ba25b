// SPDX-License-Identifier: MIT
#include <lacuna/view/picture.h>

#include <lacuna/view/detail/png.h>
#include <lacuna/view/detail/raster.h>
#include <lacuna/view/detail/scene.h>

namespace lacuna::view {

namespace {

void write(const Scene& scene, const io::OutputPath& path, const PictureOptions& options,
           const RunContext& context)
{
    const std::string bytes = png_of(rasterise(scene, options, context));
    io::WholeFile file(path);
    file.append(bytes);
    file.commit();
}

} // namespace

void write_picture(std::span<const Region> regions, const io::OutputPath& path, const PictureOptions& options,
                   const RunContext& context)
{
    write(scene_of(regions, options, context), path, options, context);
}

void write_picture(const io::Deck& deck, const io::OutputPath& path, const PictureOptions& options,
                   const RunContext& context)
{
    write(scene_of(listed_cells(deck, context), options, context), path, options, context);
}

void write_picture(const topology::Model& model, const io::OutputPath& path, const PictureOptions& options,
                   const RunContext& context)
{
    write(scene_of(model, nullptr, options), path, options, context);
}

void write_picture(const topology::OpenVolume& volume, const io::OutputPath& path,
                   const PictureOptions& options, const RunContext& context)
{
    write(scene_of(volume.model, &volume.role, options), path, options, context);
}

} // namespace lacuna::view
