// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/serve.h>

#include <lacuna/cad_worker/confine.h>
#include <lacuna/cad_worker/fill_skin.h>
#include <lacuna/cad_worker/import_cad.h>
#include <lacuna/cad_worker/recombine.h>
#include <lacuna/cad_worker/solid_builder.h>

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <utility>

namespace lacuna::cad_worker {

using namespace cad_protocol;

namespace {

/// The names that one request gives to its files. The destructor withdraws them.
class Folder {
public:
    explicit Folder(std::string name) : name_(std::move(name)) {}
    ~Folder() { withdraw(name_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string add(const std::string& file, const Descriptor& descriptor) const
    {
        return offer(name_, file, descriptor.get());
    }

private:
    std::string name_;
};

/// A solid under construction, and its files.
struct Solid {
    Solid(const std::string& name, const BeginSolidRequest& request, std::vector<Descriptor> its_files)
        : files(std::move(its_files)),
          folder(name),
          builder(request.subject, {folder.add("source.brep", files[0]), folder.add("all.brep", files[1]),
                                    folder.add("result-" + request.result, files[2])})
    {
    }

    std::vector<Descriptor> files;
    Folder folder;
    SolidBuilder builder;
};

/// Answers requests, and holds the models that earlier requests loaded.
class Desk {
public:
    /// @param progress  called with the fraction of the work that is done.
    /// @return  the bytes of the reply.
    /// @throw Error, std::bad_alloc
    std::string answer(Frame& frame, const Progress& progress)
    {
        switch (frame.opcode) {
        case Opcode::load:
            return load(frame, progress);
        case Opcode::evaluate: {
            const auto wanted = decode<EvaluateRequest>(frame.bytes);
            return encode(EvaluateReply{evaluate_curve(model(wanted.model), wanted.curve, wanted.params)});
        }
        case Opcode::project:
            return project(decode<ProjectRequest>(frame.bytes));
        case Opcode::recombine:
            return encode(recombine(decode<RecombineRequest>(frame.bytes)));
        case Opcode::fill_skin:
            return encode(fill_skin(decode<FillSkinRequest>(frame.bytes)));
        case Opcode::begin_solid:
            return begin_solid(frame);
        case Opcode::make_solid:
            return make_solid(decode<MakeSolidRequest>(frame.bytes), progress);
        case Opcode::release: {
            const std::uint64_t handle = decode<ReleaseRequest>(frame.bytes).handle;
            models_.erase(handle);
            solids_.erase(handle);
            return {};
        }
        default:
            throw ProtocolError("the request is unknown");
        }
    }

private:
    [[nodiscard]] const CadSource& model(std::uint64_t handle) const
    {
        const auto found = models_.find(handle);
        if (found == models_.end()) throw ProtocolError("the model number is unknown");
        return *found->second;
    }

    std::string load(Frame& frame, const Progress& progress)
    {
        const auto request = decode<LoadRequest>(frame.bytes);
        std::deque<Folder> folders;
        std::vector<OpenedFile> files;
        std::size_t next = 0;
        for (const LoadFile& file : request.files) {
            const Folder& folder = folders.emplace_back(std::to_string(files.size()));
            files.push_back({file.format, file.path, {}});
            for (const SentFile& sent : file.contents) {
                if (next == frame.descriptors.size())
                    throw ProtocolError("a file has a name but no descriptor");
                const std::string at = folder.add(sent.name, frame.descriptors[next++]);
                if (files.back().at.empty()) files.back().at = at;
            }
        }
        Imported imported = import_cad(files, request.tolerance, request.scale, progress);
        imported.reply.model = ++last_;
        models_[last_] = std::move(imported.source);
        return encode(imported.reply);
    }

    [[nodiscard]] std::string project(ProjectRequest request) const
    {
        const CadSource& source = model(request.model);
        if (!source.boxes.contains(request.face)) throw ProtocolError("the face number is unknown");
        project_on_face(source, request.face, request.points, request.uv);
        return encode(ProjectReply{std::move(request.points), std::move(request.uv)});
    }

    std::string begin_solid(Frame& frame)
    {
        const auto request = decode<BeginSolidRequest>(frame.bytes);
        if (frame.descriptors.size() != 3) throw ProtocolError("a solid needs three file descriptors");
        BeginSolidReply reply;
        reply.solid = ++last_;
        auto solid = std::make_unique<Solid>(formatted("solid{}", last_), request,
                                             std::move(frame.descriptors));
        for (const SolidSource& source : request.sources)
            reply.sources.push_back(solid->builder.add_source(model(source.model), source));
        solids_[last_] = std::move(solid);
        return encode(reply);
    }

    std::string make_solid(const MakeSolidRequest& request, const Progress& progress)
    {
        const auto solid = solids_.extract(request.solid);
        if (solid.empty()) throw ProtocolError("the solid number is unknown");
        return encode(solid.mapped()->builder.make(request, progress));
    }

    std::uint64_t last_ = 0; ///< handle
    std::map<std::uint64_t, std::unique_ptr<CadSource>> models_;
    std::map<std::uint64_t, std::unique_ptr<Solid>> solids_;
};

} // namespace

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
        const auto failed = [&](Failure::Kind kind, const Message& message) {
            channel.send(Opcode::failed, encode(Failure{kind, message.parts()}));
        };
        auto told = std::chrono::steady_clock::now();
        const auto progress = [&](double fraction) {
            const auto now = std::chrono::steady_clock::now();
            if (now - told < std::chrono::milliseconds(cad_protocol::kTick) && fraction < 1) return;
            told = now;
            channel.send(Opcode::progress, encode(cad_protocol::Progress{fraction}));
        };
        try {
            const std::string reply = desk.answer(request, progress);
            if (request.opcode != Opcode::release) channel.send(Opcode::done, reply);
        } catch (const ChannelClosed&) {
            return;
        } catch (const ProtocolError& error) {
            failed(Failure::backend,
                   Message("cad.protocol", "the CAD process received an invalid request: {}", error.what()));
        } catch (const InvalidInput& error) {
            failed(Failure::invalid_input, error.message());
        } catch (const NotSweepable& error) {
            failed(Failure::not_sweepable, error.message());
        } catch (const Error& error) {
            failed(Failure::backend, error.message());
        } catch (const std::bad_alloc&) {
            failed(Failure::out_of_memory, Message("cad.memory_limit", "out of memory"));
        } catch (const std::exception& error) {
            failed(Failure::backend,
                   Message("cad.gmsh", "the CAD process failed unexpectedly: {}", error.what()));
        }
    }
}

} // namespace lacuna::cad_worker
