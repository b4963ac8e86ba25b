// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/exact_geometry.h>

#include <lacuna/core/shared/constants.h>

#include <algorithm>
#include <utility>

namespace lacuna::cad {

using namespace cad_protocol;

namespace {

/// Time that a request for points may continue after it is cancelled [s]. If the request ends within this
/// time, the process is not killed and keeps the models that it holds.
constexpr double kGrace = 0.3;

/// Ask the process that holds a face or curve for points, `kBetweenPolls` at a time. Overwrites the points
/// and, on a surface, also their parameters.
/// @param kind   kind of the entity, for messages
/// @param doing  as in Task
/// @param make   `make(handle, from, count)` makes the request for some of the points.
template <class Reply, class Make>
void ask_points(const CadEntity& entity, const char* kind, const char* doing, Opcode opcode, const Make& make,
                std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context)
{
    for (std::size_t from = 0; from < points.size(); from += kBetweenPolls) {
        check_cancelled(context);
        const std::size_t count = std::min(kBetweenPolls, points.size() - from);
        Task task{entity.source->path(), doing};
        task.entity = NamedEntity{kind, entity.tag};
        task.points = count;
        task.context = &context;
        task.grace = kGrace;
        const auto request = [&](std::uint64_t handle) { return make(handle, from, count); };
        const Reply reply = entity.source->ask<Reply>(opcode, request, task);
        if (reply.points.size() != count)
            throw BackendError(Message("cad.protocol",
                                       "{}: the CAD process did not return as many points as requested",
                                       entity.source->path())
                                   .remedy("load the file again"));
        std::ranges::copy(reply.points, points.subspan(from).begin());
        if constexpr (requires { reply.uv; }) std::ranges::copy(reply.uv, uv.subspan(from).begin());
    }
}

} // namespace

// --- the process that holds the model ---------------------------------------------------------------

CadSource::Held CadSource::now() const
{
    const std::lock_guard lock(mutex_);
    return held_;
}

std::shared_ptr<Worker> CadSource::worker() const
{
    const Held held = now();
    return held.worker->lives() ? held.worker : nullptr;
}

std::uint64_t CadSource::handle_in(const std::shared_ptr<Worker>& worker, const RunContext& context) const
{
    const std::lock_guard lock(mutex_);
    if (held_.worker == worker) return held_.handle;
    const Held before = held_;
    held_ = load_again(worker, context);
    before.worker->release(before.handle);
    return held_.handle;
}

void CadSource::renew(const Held& gone, const RunContext& context) const
{
    const std::lock_guard lock(mutex_);
    if (held_.worker != gone.worker) return; // another thread has reloaded it
    held_ = load_again(Worker::current(&context, path_), context);
}

CadSource::Held CadSource::load_again(std::shared_ptr<Worker> worker, const RunContext& context) const
{
    RunContext quiet = context; // the stage that is running reports progress, not the reload
    quiet.progress = {};
    MessageParts trouble = Message("cad.file_changed", "{} has changed since it was loaded", path_).parts();
    try {
        const CadFiles files = open_cad_files(order_, quiet);
        if (files.digest == digest_) {
            const LoadReply reply = read_cad_files(*worker, order_, files, quiet);
            return {std::move(worker), reply.model};
        }
    } catch (const Cancelled&) {
        throw;
    } catch (const WorkerGone&) {
        throw;
    } catch (const Error& error) {
        trouble = error.message().parts();
    }
    const std::string remedy = std::exchange(trouble.remedy, {});
    throw BackendError(
        Message("cad.file_changed",
                "another CAD process is needed, but it cannot load the exact geometry again: {}", trouble)
            .remedy("{}", remedy.empty() ? "restore the file, or call lacuna.load again and rebuild the model"
                                         : remedy));
}

// --- points ---------------------------------------------------------------------------------------------

void CadSurface::project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const
{
    const auto make = [&](std::uint64_t handle, std::size_t from, std::size_t count) {
        const std::span<Vec3> some = points.subspan(from, count);
        const std::span<Vec2> places = uv.subspan(from, count);
        return ProjectRequest{handle, tag, {some.begin(), some.end()}, {places.begin(), places.end()}};
    };
    ask_points<ProjectReply>(*this, "face", "projecting points onto", Opcode::project, make, points, uv,
                             context);
}

void CadCurve::evaluate(std::span<const double> params, std::span<Vec3> points,
                        const RunContext& context) const
{
    if (!plain_.form.empty()) {
        std::ranges::transform(params, points.begin(), [&](double t) { return plain_.at(t); });
        return;
    }
    const auto make = [&](std::uint64_t handle, std::size_t from, std::size_t count) {
        const std::span<const double> some = params.subspan(from, count);
        return EvaluateRequest{handle, tag, {some.begin(), some.end()}};
    };
    ask_points<EvaluateReply>(*this, "curve", "evaluating", Opcode::evaluate, make, points, {}, context);
}

} // namespace lacuna::cad
