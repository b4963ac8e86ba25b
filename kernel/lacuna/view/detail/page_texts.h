// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace lacuna::view {

extern const std::string_view kPage_css; ///< the style sheet of all pages
extern const std::string_view kPage_js;  ///< the script of all pages

} // namespace lacuna::view
