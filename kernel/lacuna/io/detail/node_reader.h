// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/mesh_file.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Nodes and fields for the writers: stored in a mesh, or generated when needed. Internal to this folder.
namespace lacuna::io {

/// Values that are generated in parts, some layers at a time. The last few parts are kept.
template <class Value>
class LayerCache {
public:
    using Values = std::shared_ptr<const std::vector<Value>>;
    /// @param make  generates part `i`; any thread may call it, but only one at a time.
    explicit LayerCache(std::function<std::vector<Value>(std::size_t i)> make) : make_(std::move(make)) {}

    [[nodiscard]] Values part(std::size_t i) const
    {
        const std::lock_guard<std::mutex> hold(lock_);
        for (const auto& [number, values] : kept_)
            if (values && number == i) return values;
        kept_[next_] = {i, std::make_shared<const std::vector<Value>>(make_(i))};
        const Values made = kept_[next_].second;
        next_ = (next_ + 1) % kept_.size();
        return made;
    }
    /// Release part `i` when its last value was read. A mesh may have hundreds of readers, and each keeps
    /// parts.
    void drop(std::size_t i) const
    {
        const std::lock_guard<std::mutex> hold(lock_);
        for (auto& [number, values] : kept_)
            if (number == i) values.reset();
    }

private:
    std::function<std::vector<Value>(std::size_t)> make_;
    mutable std::mutex lock_;
    mutable std::array<std::pair<std::size_t, Values>, 3> kept_; ///< one part for each of two threads, and
                                                                 ///< one more
    mutable std::size_t next_ = 0;
};

/// The nodes of a mesh, with middle nodes after the corners.
class NodeReader {
public:
    explicit NodeReader(const mesh::HexMesh& mesh) : mesh_(mesh) {}
    NodeReader(const mesh::LayeredMesh& layered, const RunContext& context);
    NodeReader(const NodeReader&) = delete;
    NodeReader& operator=(const NodeReader&) = delete;

    [[nodiscard]] std::size_t count() const { return mesh::corner_count(mesh_) + mesh::middle_count(mesh_); }
    /// A node of the skin.
    [[nodiscard]] Vec3 on_skin(Index node) const
    {
        return layers_ != nullptr ? layers_->on_skin(node) : mesh_.node(index(node));
    }
    /// Call `take(nodes)` for consecutive spans of the nodes [begin, end). Thread-safe.
    template <class Take>
    void each_span(std::size_t begin, std::size_t end, const Take& take) const
    {
        const auto take_held = [&](const std::vector<Vec3>& held, std::size_t first) {
            const std::size_t low = std::max(begin, first), high = std::min(end, first + held.size());
            if (low < high) take(std::span(held).subspan(low - first, high - low));
        };
        if (!corners_.made) {
            take_held(mesh_.nodes, 0);
            return take_held(mesh_.middles.nodes, mesh_.nodes.size());
        }
        while (begin < end) {
            const Made& of = begin < middles_.begin ? corners_ : middles_;
            const std::size_t number = std::min((begin - of.begin) / of.step, of.parts - 1);
            const auto part = of.made->part(number);
            const std::size_t first = of.begin + number * of.step, last = std::min(end, first + part->size());
            take(std::span(*part).subspan(begin - first, last - begin));
            if (last == first + part->size()) of.made->drop(number);
            begin = last;
        }
    }

private:
    /// Consecutive nodes that are generated in parts of equal size; the last part may be smaller.
    struct Made {
        std::size_t begin = 0; ///< number of the first node
        std::size_t step = 1, parts = 1;
        std::shared_ptr<LayerCache<Vec3>> made{}; ///< null: the nodes are stored
    };

    const mesh::HexMesh& mesh_;
    const mesh::LayeredNodes* layers_ = nullptr;
    Made corners_, middles_;
};

/// A value for every cell, stored or generated; and for every skin quad, the value of the cell behind it.
class FieldReader {
public:
    explicit FieldReader(const CellField& field);
    /// @param team  shares the computation of values for the skin
    FieldReader(const mesh::HexMesh& mesh, const LayeredField& field, const RunContext& context,
                const Team* team);

    [[nodiscard]] const std::string& name() const { return name_; }

    /// Call `visit(i, value)` for each i in [begin, end), where `value` is that of cell `cell_of(i)`.
    /// Thread-safe.
    template <class CellOf, class Visit>
    void each_cell(std::size_t begin, std::size_t end, const CellOf& cell_of, const Visit& visit) const
    {
        std::array<std::uint32_t, mesh::MeshView::Block::kAtOnce> cells;
        std::array<double, cells.size()> values;
        while (begin < end) {
            const std::size_t count = std::min(cells.size(), end - begin);
            for (std::size_t k = 0; k < count; ++k) cells[k] = static_cast<std::uint32_t>(cell_of(begin + k));
            make_(std::span<const std::uint32_t>(cells).first(count), values.data());
            for (std::size_t k = 0; k < count; ++k) visit(begin + k, values[k]);
            begin += count;
        }
    }

    /// Call `visit(i, value)` for each i in [begin, end), where `value` is that of the cell behind quad
    /// `quad_of(i)` of the skin. Thread-safe.
    /// @param cells  result of `cells_of_skin()`
    template <class QuadOf, class Visit>
    void each_behind_skin(std::size_t begin, std::size_t end, const std::vector<std::uint32_t>& cells,
                          const QuadOf& quad_of, const Visit& visit) const
    {
        if (skin_.empty())
            return each_cell(
                begin, end, [&](std::size_t i) { return std::size_t(cells[quad_of(i)]); }, visit);
        for (std::size_t i = begin; i < end; ++i) visit(i, skin_[quad_of(i)]);
    }

private:
    std::string name_;
    std::function<void(std::span<const std::uint32_t> cells, double* out)> make_; ///< as `CellField::make`
    std::vector<double> skin_; ///< for each quad of the skin, the value of its cell; only if values are
                               ///< generated
};

/// @throw InvalidInput  the name cannot be written or is in use; `names` holds the earlier ones.
void check_field_name(const std::string& name, std::set<std::string>& names);

/// Readers for stored or generated fields.
/// @throw InvalidInput  as `check_fields()`
std::vector<FieldReader> readers_of(const mesh::HexMesh& mesh, const std::vector<CellField>& fields);
std::vector<FieldReader> readers_of(const mesh::LayeredMesh& layered, const std::vector<LayeredField>& fields,
                                    const RunContext& context, const Team* team);

} // namespace lacuna::io
