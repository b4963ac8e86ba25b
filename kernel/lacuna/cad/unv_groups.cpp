// SPDX-License-Identifier: GPL-2.0-or-later
//
// Gmsh reads the nodes and elements of universal files, but not to which named groups they belong.
#include <lacuna/cad/detail/import_facets.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace lacuna::cad {

namespace {

/// Datasets of permanent groups with two entities of four numbers in a line.
constexpr std::array kGroupDatasets{2429, 2430, 2432, 2435, 2452, 2467, 2477};
/// What an entity of a group must be to count.
constexpr int kElement = 8;

bool is_mark(const std::string& line)
{
    return std::atoi(line.c_str()) == -1 && line.find_first_not_of(" -1\r\t") == std::string::npos &&
           line.find("-1") != std::string::npos;
}

std::vector<long> numbers_in(const std::string& line)
{
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::vector<long> numbers;
    for (long n = 0; words >> n;) numbers.push_back(n);
    return numbers;
}

/// The groups of one dataset, up to its closing mark.
void read_dataset(std::ifstream& file, std::map<std::size_t, UnvGroup>& groups)
{
    std::string line;
    while (std::getline(file, line) && !is_mark(line)) {
        const std::vector<long> head = numbers_in(line);
        if (head.size() < 8 || !std::getline(file, line)) return;
        UnvGroup group{static_cast<int>(head[0]), line};
        while (!group.name.empty() && std::isspace(static_cast<unsigned char>(group.name.back())))
            group.name.pop_back();
        group.name.erase(0, group.name.find_first_not_of(" \t"));
        for (long left = head[7]; left > 0 && std::getline(file, line); left -= 2) {
            const std::vector<long> entities = numbers_in(line);
            for (std::size_t i = 0; i + 1 < entities.size(); i += 4) {
                if (entities[i] == kElement)
                    groups.try_emplace(static_cast<std::size_t>(entities[i + 1]), group);
            }
        }
    }
}

} // namespace

std::map<std::size_t, UnvGroup> read_unv_groups(const std::string& path)
{
    std::map<std::size_t, UnvGroup> groups;
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        if (!is_mark(line) || !std::getline(file, line)) continue;
        const int dataset = std::atoi(line.c_str());
        if (std::find(kGroupDatasets.begin(), kGroupDatasets.end(), dataset) != kGroupDatasets.end()) {
            read_dataset(file, groups);
            continue;
        }
        while (std::getline(file, line) && !is_mark(line)) {}
    }
    return groups;
}

} // namespace lacuna::cad
