// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace lacuna::view {

extern const std::string_view kPage_css; ///< the style sheet of every page
extern const std::string_view kPage_js;  ///< its script, which reads the data and draws it

} // namespace lacuna::view
