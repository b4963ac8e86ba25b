// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"

#include <lacuna/core/error.h>
#include <lacuna/fill.h>
#include <lacuna/interpreter.h>

#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lacuna::test {

/// A recipe whose objects are read from C++, so that both fill the very same model.
class Recipe {
public:
    explicit Recipe(const std::string& text = {}, InterpreterOptions options = quiet())
        : interpreter_(std::move(options))
    {
        run("lacuna = require 'lacuna'");
        run(text);
    }
    void run(const std::string& text) { interpreter_.run_string(text); }
    /// The code of the error that a recipe ends with; empty: none.
    std::string code_of(const std::string& text)
    {
        try {
            run(text);
        } catch (const ScriptError& error) {
            return error.code();
        }
        return {};
    }
    std::string text(const std::string& expression)
    {
        run("text_ = tostring(" + expression + ")");
        return std::get<std::string>(interpreter_.get("text_"));
    }
    /// What a global variable holds; null: something else.
    template <class T>
    std::shared_ptr<T> object(const char* name)
    {
        lua_State* const state = interpreter_.state();
        lua_getglobal(state, name);
        const lua::Box<T>* const box = lua::test_box<T>(state, -1);
        std::shared_ptr<T> held = box != nullptr ? *box : nullptr;
        lua_pop(state, 1);
        return held;
    }
    Interpreter& interpreter() { return interpreter_; }

    static InterpreterOptions quiet()
    {
        InterpreterOptions options;
        options.log = [](std::string_view) {};
        options.print = [](std::string_view) {};
        return options;
    }

private:
    Interpreter interpreter_;
};

/// What two meshes of one sweep differ in; empty: they are the same to the bit.
inline std::string difference(const sweep::Swept& a, const sweep::Swept& b)
{
    const auto same = [](const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(Vec3)) == 0);
    };
    const auto same_patch = [](const mesh::SkinPatch& x, const mesh::SkinPatch& y) {
        return x.tag == y.tag && x.groups == y.groups && x.face == y.face;
    };
    if (!same(a.mesh.nodes, b.mesh.nodes)) return "nodes";
    if (!same(a.mesh.middles.nodes, b.mesh.middles.nodes)) return "middle nodes";
    if (a.mesh.quads != b.mesh.quads || a.mesh.layers != b.mesh.layers) return "cells";
    if (!std::ranges::equal(a.mesh.patches, b.mesh.patches, same_patch)) return "patches";
    if (a.mesh.volume_groups != b.mesh.volume_groups) return "regions";
    if (a.report != b.report) return "report";
    return {};
}

/// What the mesh of a recipe, its global `mesh`, and that of fill() differ in.
inline std::string difference(Recipe& recipe, const fill::Filled& filled)
{
    if (const auto mesh = recipe.object<lua::MeshState>("mesh")) {
        const auto* own = std::get_if<fill::FilledVolume>(&filled.mesh);
        if (own == nullptr) return "a mesh of parts";
        return mesh->material != own->material ? "material" : difference(mesh->swept, own->swept);
    }
    const auto mesh = recipe.object<lua::AssemblyMeshState>("mesh");
    const auto* own = std::get_if<fill::FilledParts>(&filled.mesh);
    if (!mesh) return "no mesh of a recipe";
    if (own == nullptr) return "a mesh of one volume";
    if (mesh->regions != own->regions || mesh->materials != own->materials) return "regions";
    for (std::size_t p = 0; p < own->regions.size(); ++p)
        if (mesh->swept.numbering[p].first() != own->swept.numbering[p].first() ||
            mesh->swept.numbering[p].known() != own->swept.numbering[p].known())
            return "numbers of nodes";
    if (fill::report(*mesh) != fill::report(*own)) return "report";
    if (mesh->left_out.size() != own->left_out.size()) return "what is left out";
    for (std::size_t p = 0; p < own->regions.size(); ++p) {
        const std::string found = difference(mesh->swept.parts[p], own->swept.parts[p]);
        if (!found.empty()) return own->regions[p] + ": " + found;
    }
    return {};
}

/// The code of the error that a call ends with; empty: none.
inline std::string code_of(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& error) {
        return error.code();
    }
    return {};
}

} // namespace lacuna::test
