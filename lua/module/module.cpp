// SPDX-License-Identifier: MIT
// The module is the bindings and nothing else: luaopen_lacuna comes out of lacuna::lua (bindings/open.cpp).
