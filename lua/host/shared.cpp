// SPDX-License-Identifier: MIT
// The shared library is lacuna_host and all below it; what it shows is in exports.map.
