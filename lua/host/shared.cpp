// SPDX-License-Identifier: MIT
// The shared library contains lacuna_host and the libraries below it; exports.map lists its symbols.
