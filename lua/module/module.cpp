// SPDX-License-Identifier: MIT
// The module contains the bindings only: luaopen_lacuna comes from lacuna::lua (bindings/open.cpp).
