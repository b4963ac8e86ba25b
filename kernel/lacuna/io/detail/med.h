// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// MED, the format of Salome and Code_Aster, which is read and written by libmedC (LGPL-3). Internal to this
/// folder. https://docs.salome-platform.org/latest/dev/MEDCoupling/developer/med-file.html
namespace lacuna::io {

struct MedCells {
    std::int32_t type = 0;
    std::vector<std::int32_t> nodes{}, families{}, numbers{}; ///< `numbers`: empty if the file gives none
};
struct MedFamily {
    std::int32_t number = 0; ///< above 0 for nodes, below 0 for cells
    std::vector<std::string> groups{};
};
/// Content of a file, as it is sent from one process to the other.
struct MedContent {
    std::string error{}; ///< not empty: the reason why the file cannot be read
    std::string unit{};
    std::vector<Vec3> points{};
    std::vector<std::int32_t> point_families{}, point_numbers{};
    std::vector<MedCells> cells{};
    std::vector<MedFamily> families{};
    std::vector<std::string> notes{};
};

/// The content of a file. @throw BackendError "io.no_med"  the library is missing
MedContent med_content(std::string_view bytes);
/// The bytes of a file. Names of groups that are too long are cut, with a note.
/// @throw BackendError "io.no_med"; "io.med_library"  the library cannot write the file
std::string med_bytes(MedContent& content);

} // namespace lacuna::io
