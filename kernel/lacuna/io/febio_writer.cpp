// SPDX-License-Identifier: MIT
//
// The mesh of a FEBio file, format 4.0: nodes, parts of elements of one shape, surfaces, sets and domains.
// https://help.febio.org/docs/FEBioUser-4-0/
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/side_nodes.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>

namespace lacuna::io {

namespace {

using mesh::MeshView;
using mesh::SetKind;

/// The position of FEBio's node `k` in the order of DeckShape. In a hex27, FEBio lists the centres of the
/// four side faces before the centres of the bottom and top faces.
std::size_t place_of(DeckShape shape, std::size_t k)
{
    constexpr std::size_t kCentres[] = {22, 21, 23, 20, 24, 25, 26};
    return shape == DeckShape::hex27 && k >= 20 ? kCentres[k - 20] : k;
}

class FebioWriter {
public:
    explicit FebioWriter(const View& view) : view_(view), sides_(*view) {}

    DeckFile write(const std::string& unit)
    {
        file_.add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n" +
                  (unit.empty() ? "" : "  <!-- lengths are in " + unit + " -->\n") +
                  "  <Module type=\"solid\"/>\n  <Mesh>\n");
        file_.sections.push_back(
            section_of_points("    <Nodes name=\"nodes\">\n", view_, 5 * kNumberBytes, put_node));
        file_.add("    </Nodes>\n");
        for (std::size_t b = 0; b < view_->blocks.size(); ++b) add_elements(b);
        for (std::size_t s = 0; s < view_->sets.size(); ++s) add_set(s);
        for (const mesh::ContactPair& pair : view_->contacts)
            file_.add(formatted("    <SurfacePair name=\"{}\">\n      <primary>{}</primary>\n"
                                "      <secondary>{}</secondary>\n    </SurfacePair>\n",
                                xml_text(pair.name), xml_text(surface_names_[pair.sets[0]]),
                                xml_text(surface_names_[pair.sets[1]])));
        file_.add("  </Mesh>\n  <MeshDomains>\n" + domains_ + "  </MeshDomains>\n");
        if (!axes_.empty()) {
            file_.add("  <MeshData>\n");
            std::ranges::move(axes_, std::back_inserter(file_.sections));
            file_.add("    </ElementData>\n  </MeshData>\n");
        }
        if (!view_->contacts.empty()) {
            file_.add("  <Contact>\n");
            for (const mesh::ContactPair& pair : view_->contacts)
                file_.add(formatted(
                    "    <contact type=\"{}-elastic\" name=\"{}\" surface_pair=\"{}\">\n"
                    "      <auto_penalty>1</auto_penalty>\n{}    </contact>\n",
                    pair.tied ? "tied" : "sliding", xml_text(pair.name), xml_text(pair.name),
                    pair.tied ? formatted("      <search_radius>{}</search_radius>\n", pair.tolerance) : ""));
            file_.add("  </Contact>\n");
        }
        file_.add("</febio_spec>\n");
        return std::move(file_);
    }

private:
    static char* put_node(std::size_t, DeckTag tag, const Vec3& point, char* out)
    {
        return put_text(out, "      <node id=\"", tag, "\">", point[0], ",", point[1], ",", point[2],
                        "</node>\n");
    }

    /// Add the elements of one shape and region: a part and its domain.
    void add_elements(std::size_t b)
    {
        const MeshView::Block& block = view_->blocks[b];
        const std::string word = words_of(block.shape).febio;
        if (word.empty()) refuse_element(block, "FEBio", "there is no such element");
        const auto put = [view = view_, shape = block.shape](DeckTag tag, std::span<const Index> nodes,
                                                             char* out) {
            out = put_text(out, "      <elem id=\"", tag, "\">");
            for (std::size_t k = 0; k < nodes.size(); ++k)
                out = put_text(out, k > 0 ? "," : "", view->point_tags[index(nodes[place_of(shape, k)])]);
            return put_text(out, "</elem>\n");
        };
        for (auto& [region, elements] : cells_by_region(block)) {
            const std::string material = region < 0 ? "elements" : region_name(view_->regions[index(region)]);
            const std::string part = free(material, material + "_" + word, parts_);
            ++wholes_[material].first;
            wholes_[material].second += elements.count();
            if (view_->frames && !(*view_->frames)[b].empty() &&
                !(*view_->frames)[b][elements[0]].column.isZero()) // unlike cells of no thickness
                add_axes(b, part, elements);
            file_.sections.push_back(
                section_of_cells(formatted("    <Elements type=\"{}\" name=\"{}\">\n", word, xml_text(part)),
                                 view_, b, elements, 29 * kNumberBytes, put));
            file_.add("    </Elements>\n");
            domains_ += formatted("    <{} name=\"{}\" mat=\"{}\"/>\n",
                                  shape_info(block.shape).dimension == 3 ? "SolidDomain" : "ShellDomain",
                                  xml_text(part), xml_text(material));
        }
    }

    /// The first two axes of the material of each element of a part.
    void add_axes(std::size_t b, const std::string& part, const mesh::Ranges& elements)
    {
        const char* const end = axes_.empty() ? "" : "    </ElementData>\n";
        axes_.push_back(
            {formatted("{}    <ElementData type=\"mat_axis\" elem_set=\"{}\">\n", end, xml_text(part)),
             elements.count(), 11 * kNumberBytes,
             [view = view_, b, elements](std::size_t begin, std::size_t last, char* out) {
                 for (; begin < last; ++begin) {
                     const auto [a, d, normal] = (*view->frames)[b][elements[begin]].material();
                     out = put_text(out, "      <elem lid=\"", begin + 1, "\"><a>", a[0], ",", a[1], ",",
                                    a[2], "</a><d>", d[0], ",", d[1], ",", d[2], "</d></elem>\n");
                 }
                 return out;
             }});
    }

    static std::string region_name(const MeshView::Region& region)
    {
        return region.name.empty() ? "part_" + std::to_string(region.tag) : region.name;
    }

    /// A name that is not in use: `first`, else `second`, else `second` with a number.
    static std::string free(const std::string& first, const std::string& second, std::set<std::string>& used)
    {
        if (used.insert(first).second) return first;
        std::string name = second;
        for (int i = 2; !used.insert(name).second; ++i) name = second + "_" + std::to_string(i);
        return name;
    }

    void add_set(std::size_t s)
    {
        const MeshView::Set& set = view_->sets[s];
        if (set.kind == SetKind::sides) return add_surface(s);
        // FEBio makes an element set of each part, so a set that equals a part is not written.
        const auto whole = wholes_.find(set.name);
        const bool is_part = set.kind == SetKind::elements && whole != wholes_.end() &&
                             whole->second == std::pair(1, set.count);
        if (set.count == 0 || is_part) return;
        const std::string_view word = set.kind == SetKind::nodes ? "NodeSet" : "ElementSet";
        std::set<std::string>& used = set.kind == SetKind::nodes ? node_sets_ : parts_;
        const std::string name = free(set.name, set.name + "_cells", used);
        file_.sections.push_back(
            section_of_members(formatted("    <{} name=\"{}\">", word, xml_text(name)), view_, s,
                               kNumberBytes, [count = set.count](std::size_t i, DeckTag tag, char* out) {
                                   return put_text(out, tag, i + 1 < count ? "," : "");
                               }));
        file_.add(formatted("</{}>\n", word));
    }

    void add_surface(std::size_t s)
    {
        const MeshView::Set& set = view_->sets[s];
        std::string text;
        std::size_t number = 0;
        sides_.each_face(set, file_.notes, [&](std::span<const Index> nodes) {
            const std::string word = (nodes.size() % 3 == 0 && nodes.size() < 9 ? "tri" : "quad") +
                                     std::to_string(nodes.size());
            text += formatted("      <{} id=\"{}\">", word, ++number);
            for (std::size_t k = 0; k < nodes.size(); ++k)
                text += (k > 0 ? "," : "") + std::to_string(view_->point_tags[index(nodes[k])]);
            text += formatted("</{}>\n", word);
        });
        if (number == 0) return;
        const std::string name = surface_names_[s] = free(set.name, set.name + "_surface", surfaces_);
        file_.add(formatted("    <Surface name=\"{}\">\n{}    </Surface>\n", xml_text(name), text));
    }

    View view_;
    SideNodes sides_;
    DeckFile file_;
    std::string domains_;
    std::vector<Section> axes_; ///< of the parts whose elements have directions
    std::map<std::string, std::pair<int, std::size_t>> wholes_; ///< number of parts and of elements of each
                                                                ///< region
    std::set<std::string> parts_, node_sets_, surfaces_;        ///< names in use
    std::map<std::size_t, std::string> surface_names_;          ///< of sets of sides
};

} // namespace

DeckFile febio_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    check_numbers(*view, std::numeric_limits<std::int32_t>::max(), "a FEBio file",
                  "give first_node and first_cell");
    return FebioWriter(view).write(options.unit);
}

} // namespace lacuna::io
