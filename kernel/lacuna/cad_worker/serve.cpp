// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/serve.h>

#include <lacuna/cad_worker/confine.h>
#include <lacuna/cad_worker/import_cad.h>
#include <lacuna/cad_worker/recombine.h>
#include <lacuna/cad_worker/solid_builder.h>

#include <chrono>
#include <map>
#include <utility>

namespace lacuna::cad_worker {

using namespace cad_protocol;

namespace {

/// The names of the files of one request, withdrawn by the destructor.
class Folder {
public:
    explicit Folder(std::string name) : name_(std::move(name)) {}
    ~Folder()
    {
        if (!name_.empty()) withdraw(name_);
    }
    Folder(Folder&& other) noexcept : name_(std::exchange(other.name_, {})), own_(std::move(other.own_)) {}
    Folder& operator=(Folder&&) = delete;
    std::string add(const std::string& file, int descriptor) { return offer(name_, file, descriptor); }
    std::string add(const std::string& file, Descriptor&& descriptor)
    {
        return add(file, own_.emplace_back(std::move(descriptor)).get());
    }

private:
    std::string name_;
    std::vector<Descriptor> own_;
};

/// A solid under construction, and its files.
struct Solid {
    Solid(Folder its_folder, const std::string& subject, const SolidFiles& files)
        : folder(std::move(its_folder)), builder(subject, files)
    {
    }
    Folder folder;
    SolidBuilder builder;
};

} // namespace

struct Desk::State {
    std::uint64_t last = 0;
    std::map<std::uint64_t, std::unique_ptr<CadSource>> models;
    std::map<std::uint64_t, std::unique_ptr<Solid>> solids;

    const CadSource& model(std::uint64_t handle) const
    {
        const auto found = models.find(handle);
        if (found == models.end()) throw ProtocolError("the model number is unknown");
        return *found->second;
    }
    std::string load(Frame& frame, const Progress& progress);
    std::string evaluate(const EvaluateRequest& request) const;
    std::string project(ProjectRequest request) const;
    std::string begin_solid(Frame& frame);
    std::string make_solid(const MakeSolidRequest& request, const Progress& progress);
};

std::string Desk::State::load(Frame& frame, const Progress& progress)
{
    const auto request = decode<LoadRequest>(frame.bytes);
    std::vector<Folder> folders;
    std::vector<OpenedFile> files;
    std::size_t next = 0;
    for (const LoadFile& file : request.files) {
        Folder& folder = folders.emplace_back(std::to_string(files.size()));
        files.push_back({file.format, file.path, {}});
        for (const SentFile& sent : file.contents) {
            if (next == frame.descriptors.size()) throw ProtocolError("a file has a name but no descriptor");
            const std::string at = folder.add(sent.name, frame.descriptors[next++].get());
            if (files.back().at.empty()) files.back().at = at;
        }
    }
    Imported imported = import_cad(files, request.tolerance, request.scale, progress);
    imported.reply.model = ++last;
    models[last] = std::move(imported.source);
    return encode(imported.reply);
}

std::string Desk::State::evaluate(const EvaluateRequest& request) const
{
    return encode(EvaluateReply{evaluate_curve(model(request.model), request.curve, request.params)});
}

std::string Desk::State::project(ProjectRequest request) const
{
    const CadSource& source = model(request.model);
    if (!source.boxes.contains(request.face)) throw ProtocolError("the face number is unknown");
    project_on_face(source, request.face, request.points, request.uv);
    return encode(ProjectReply{std::move(request.points), std::move(request.uv)});
}

std::string Desk::State::begin_solid(Frame& frame)
{
    const auto request = decode<BeginSolidRequest>(frame.bytes);
    if (frame.descriptors.size() != 3) throw ProtocolError("a solid needs three file descriptors");
    const std::uint64_t handle = ++last;
    Folder folder("solid" + std::to_string(handle));
    const SolidFiles files{folder.add("source.brep", std::move(frame.descriptors[0])),
                           folder.add("all.brep", std::move(frame.descriptors[1])),
                           folder.add("result-" + request.result, std::move(frame.descriptors[2]))};
    auto solid = std::make_unique<Solid>(std::move(folder), request.subject, files);
    BeginSolidReply reply;
    reply.solid = handle;
    for (const SolidSource& source : request.sources)
        reply.sources.push_back(solid->builder.add_source(model(source.model), source));
    solids[handle] = std::move(solid);
    return encode(reply);
}

std::string Desk::State::make_solid(const MakeSolidRequest& request, const Progress& progress)
{
    const auto found = solids.find(request.solid);
    if (found == solids.end()) throw ProtocolError("the solid number is unknown");
    const std::unique_ptr<Solid> solid = std::move(found->second);
    solids.erase(found);
    return encode(solid->builder.make(request, progress));
}

Desk::Desk() : state_(std::make_unique<State>()) {}
Desk::~Desk() = default;

std::string Desk::answer(Frame& frame, const Progress& progress)
{
    switch (frame.opcode) {
    case Opcode::load:
        return state_->load(frame, progress);
    case Opcode::evaluate:
        return state_->evaluate(decode<EvaluateRequest>(frame.bytes));
    case Opcode::project:
        return state_->project(decode<ProjectRequest>(frame.bytes));
    case Opcode::recombine:
        return encode(recombine(decode<RecombineRequest>(frame.bytes)));
    case Opcode::begin_solid:
        return state_->begin_solid(frame);
    case Opcode::make_solid:
        return state_->make_solid(decode<MakeSolidRequest>(frame.bytes), progress);
    case Opcode::release: {
        const std::uint64_t handle = decode<ReleaseRequest>(frame.bytes).handle;
        state_->models.erase(handle);
        state_->solids.erase(handle);
        return {};
    }
    default:
        throw ProtocolError("the request is unknown");
    }
}

void serve(Channel& channel, const std::string& missing)
{
    channel.send(Opcode::hello, encode(Hello{Gmsh::version(), missing}));
    Desk desk;
    for (;;) {
        Frame request;
        try {
            request = channel.receive();
        } catch (const ProtocolError&) {
            return;
        }
        const auto failed = [&](Failure::Kind kind, const std::string& code, const std::string& message) {
            channel.send(Opcode::failed, encode(Failure{kind, code, message}));
        };
        // Report progress no more often than a person can see it.
        constexpr auto kPause = std::chrono::milliseconds(20);
        auto told = std::chrono::steady_clock::now();
        const auto progress = [&](double fraction) {
            const auto now = std::chrono::steady_clock::now();
            if (now - told < kPause && fraction < 1) return;
            told = now;
            channel.send(Opcode::progress, encode(cad_protocol::Progress{fraction}));
        };
        try {
            const std::string reply = desk.answer(request, progress);
            if (request.opcode != Opcode::release) channel.send(Opcode::done, reply);
        } catch (const ChannelClosed&) {
            return;
        } catch (const ProtocolError& error) {
            failed(Failure::backend, "cad.protocol", error.what());
        } catch (const InvalidInput& error) {
            failed(Failure::invalid_input, error.code(), error.what());
        } catch (const NotSweepable& error) {
            failed(Failure::not_sweepable, error.code(), error.what());
        } catch (const Error& error) {
            failed(Failure::backend, error.code(), error.what());
        } catch (const std::bad_alloc&) {
            failed(Failure::out_of_memory, "cad.memory_limit", "out of memory");
        } catch (const std::exception& error) {
            failed(Failure::backend, "cad.gmsh", error.what());
        }
    }
}

} // namespace lacuna::cad_worker
