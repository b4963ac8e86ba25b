// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/session.h>

#include <lacuna/cad_worker/detail/gmsh_api.h>

#include <algorithm>
#include <clocale>
#include <iostream>
#include <ranges>

namespace lacuna::cad_worker {

namespace {

bool model_exists(const std::string& name)
{
    std::vector<std::string> names;
    gmsh::model::list(names);
    return std::find(names.begin(), names.end(), name) != names.end();
}

void read_option(const std::string& name, double& value) { gmsh::option::getNumber(name, value); }
void read_option(const std::string& name, std::string& value) { gmsh::option::getString(name, value); }
void write_option(const std::string& name, double value) { gmsh::option::setNumber(name, value); }
void write_option(const std::string& name, const std::string& value) { gmsh::option::setString(name, value); }

} // namespace

Gmsh::Gmsh()
{
    // No arguments, as Gmsh exits on unknown ones; no start-up files of the user.
    gmsh::initialize(0, nullptr, false);
    std::setlocale(LC_ALL, "C");
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.Verbosity", 2);    // warnings and errors
    gmsh::option::setNumber("General.AbortOnError", 2); // throw
}

Gmsh::~Gmsh()
{
    try {
        gmsh::finalize();
    } catch (...) { // Nothing can be done here, and a destructor must not throw.
    }
}

std::string Gmsh::version()
{
    std::string version;
    gmsh::option::getString("General.Version", version);
    return version;
}

/// Restore an option at the end of the session.
/// @param next  value of the option during the session; if empty, it keeps its value, which a script may
///              change.
template <class Value>
void Session::save(const std::string& option, const std::optional<Value>& next)
{
    Value before{};
    try {
        read_option(option, before);
    } catch (...) {
        return;
    }
    if (next == before) return;
    if (next) write_option(option, *next);
    restores_.emplace_back([option, before] { write_option(option, before); });
}

Session::Session(std::string subject) : subject_(std::move(subject))
{
    run([&] { gmsh::logger::getLastError(last_error_); });
    // Options that a script may set. Its Mesh options need no restoring: only recombine() and fill_skin()
    // mesh, and they set their own.
    for (const char* option : {"General.Terminal", "General.Verbosity", "General.AbortOnError",
                               "General.NumThreads", "Geometry.Tolerance", "Geometry.AutoCoherence"})
        run([&] { save<double>(option, std::nullopt); });
}

Session::~Session()
{
    try {
        for (const auto& restore : std::views::reverse(restores_)) restore();
    } catch (...) { // A destructor must not throw.
    }
}

void Session::set(const std::string& option, double value) { save<double>(option, value); }
void Session::set(const std::string& option, const std::string& value) { save<std::string>(option, value); }

void Session::set_sizes_from_boundary()
{
    set("Mesh.MeshSizeFromPoints", 0);
    set("Mesh.MeshSizeFromCurvature", 0);
    set("Mesh.MeshSizeFromParametricPoints", 0);
    set("Mesh.MeshSizeExtendFromBoundary", 1);
    set("Mesh.MeshSizeMin", 0);
    set("Mesh.MeshSizeMax", 1e22);
    set("Mesh.MeshSizeFactor", 1);
    set("Mesh.ElementOrder", 1);
    set("Mesh.SubdivisionAlgorithm", 0);
}

void Session::fail(const std::string& message) const
{
    std::string words = message;
    if (words.empty()) {
        gmsh::logger::getLastError(words);
        if (words == last_error_) words.clear(); // the error belongs to an earlier file
    }
    if (words.empty()) words = "it gave no reason";
    if (words.starts_with("Out of memory")) throw std::bad_alloc(); // Gmsh's allocator reports this as text
    const Message why("cad.gmsh", "Gmsh failed: {}", words);
    // A script that numbers its entities by hand, after a file whose entities have these numbers.
    refuse(words.ends_with("already exists")
               ? why.remedy("name the script first, or number by newv, news … in it")
               : why);
}

void Session::refuse(const Message& message) const
{
    throw BackendError(subject_.empty() ? message : message.about(subject_));
}

GmshModel::GmshModel(Session& session)
{
    static unsigned counter = 0;
    session.run([&] {
        do {
            name_ = formatted("lacuna:{}", ++counter);
        } while (model_exists(name_));
        gmsh::model::add(name_);
    });
}

GmshModel::~GmshModel()
{
    try {
        if (!model_exists(name_)) return;
        gmsh::model::setCurrent(name_);
        gmsh::model::remove();
    } catch (...) { // A destructor must not throw.
    }
}

void GmshModel::activate(Session& session) const
{
    session.run([&] { gmsh::model::setCurrent(name_); });
}

CapturedOutput::CapturedOutput() : before_(std::cout.rdbuf(text_.rdbuf())) {}
CapturedOutput::~CapturedOutput() { std::cout.rdbuf(before_); }

std::string CapturedOutput::text() const
{
    std::string plain;
    const std::string raw = text_.str();
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (raw[i] == '\x1b') {
            while (i < raw.size() && raw[i] != 'm') ++i;
        } else if (raw[i] == '\n' || raw[i] == '*') {
            if (!plain.empty() && plain.back() != ' ') plain += ' ';
        } else {
            plain += raw[i];
        }
    }
    while (!plain.empty() && plain.back() == ' ') plain.pop_back();
    return plain;
}

} // namespace lacuna::cad_worker
