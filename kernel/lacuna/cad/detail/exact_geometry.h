// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/cad_files.h>
#include <lacuna/cad/detail/worker.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/exact.h>
#include <lacuna/geometry/shared/plain_curve.h>
#include <lacuna/topology/shared/left_out.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace lacuna::cad {

/// A model in the CAD process, kept there as long as this object exists. The exact curves and surfaces of the
/// model share this object.
///
/// If the process has ended, the next request loads the files again into a new process. This fails if the
/// files have changed. The facets of the model are not read again.
class CadSource {
public:
    CadSource(std::shared_ptr<Worker> worker, std::uint64_t handle, CadOrder order, std::uint64_t digest)
        : path_(subject_of(order)),
          order_(std::move(order)),
          digest_(digest),
          held_{std::move(worker), handle}
    {
    }
    ~CadSource() { held_.worker->release(held_.handle); }
    CadSource(const CadSource&) = delete;
    CadSource& operator=(const CadSource&) = delete;

    /// Send a request to the process that holds the model.
    /// @param make  makes the request from the handle of the model.
    /// @throw BackendError  the process ended during this request; "cad.file_changed": the process had ended
    ///        before, and the files have changed since they were loaded.
    /// @throw Cancelled
    template <class Reply, class Make>
    Reply ask(cad_protocol::Opcode opcode, const Make& make, const Task& task) const
    {
        for (int i = 0;; ++i) {
            const Held held = now();
            try {
                return held.worker->ask<Reply>(opcode, make(held.handle), task);
            } catch (const WorkerGone&) {
                if (i + 1 == kIdleRounds) throw; // the process is killed again and again
                renew(held, *task.context);
            }
        }
    }

    /// The running process that holds the model; null if it has ended.
    [[nodiscard]] std::shared_ptr<Worker> worker() const;
    /// The handle of the model in `worker`. If `worker` does not hold the model, it loads the files first.
    /// @throw as ask()
    std::uint64_t handle_in(const std::shared_ptr<Worker>& worker, const RunContext& context) const;

    [[nodiscard]] const std::string& path() const { return path_; }

private:
    struct Held {
        std::shared_ptr<Worker> worker;
        std::uint64_t handle = 0;
    };
    [[nodiscard]] Held now() const;
    void renew(const Held& gone, const RunContext& context) const;
    [[nodiscard]] Held load_again(std::shared_ptr<Worker> worker, const RunContext& context) const;

    std::string path_;
    CadOrder order_;
    std::uint64_t digest_;
    mutable std::mutex mutex_;
    mutable Held held_; ///< guarded by `mutex_`
};

/// A face or curve of a loaded model.
struct CadEntity {
    std::shared_ptr<const CadSource> source;
    int tag = 0; ///< tag of the entity in the source file
};

/// A face of a loaded model, as an exact surface.
class CadSurface final : public geometry::ExactSurface, public CadEntity {
public:
    explicit CadSurface(CadEntity entity) : CadEntity(std::move(entity)) {}
    void project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const override;
};

/// A curve of a loaded model, as an exact curve.
class CadCurve final : public geometry::ExactCurve, public topology::BesideLeftOut, public CadEntity {
public:
    /// @param plain  the same curve as a line or arc, which is evaluated without the CAD process.
    CadCurve(CadEntity entity, geometry::PlainCurve plain, std::vector<topology::LeftOutFace> left_out)
        : CadEntity(std::move(entity)), plain_(std::move(plain)), left_out_(std::move(left_out))
    {
    }
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& context) const override;
    [[nodiscard]] const std::vector<topology::LeftOutFace>& left_out() const override { return left_out_; }

private:
    geometry::PlainCurve plain_;
    std::vector<topology::LeftOutFace> left_out_;
};

} // namespace lacuna::cad
