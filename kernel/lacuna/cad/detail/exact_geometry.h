// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/cad_files.h>
#include <lacuna/cad/detail/worker.h>
#include <lacuna/geometry/exact.h>
#include <lacuna/geometry/plain_curve.h>
#include <lacuna/topology/left_out.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace lacuna::cad {

/// A model the CAD process holds, for as long as this object lives; shared by its exact curves and surfaces.
///
/// Where the process has ended meanwhile, whoever ended it, the next request has the files read again, by the
/// process there is then. They must hold what they held; the facets of the model stay those of the first
/// reading. Safe for several threads.
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

    /// Ask the process that holds the model.
    /// @param make  the request for a handle.
    /// @throw BackendError  what became of the process over this request; "cad.file_changed": it had ended
    ///         before, and the files do not hold what they held. Cancelled.
    template <class Reply, class Make>
    Reply ask(cad_protocol::Opcode opcode, const Make& make, const Task& task) const
    {
        constexpr int kTries = 3; // a process that someone ends over and over again is not started for ever
        for (int i = 0;; ++i) {
            const Held held = now();
            try {
                return held.worker->ask<Reply>(opcode, make(held.handle), task);
            } catch (const WorkerGone& gone) {
                if (i + 1 == kTries) throw;
                renew(held, gone.what(), *task.context);
            }
        }
    }

    /// The living process that holds the model; null where it has ended.
    [[nodiscard]] std::shared_ptr<Worker> worker() const;
    /// The model's handle in a process, which reads the files where it does not hold it. @throw as ask()
    std::uint64_t handle_in(const std::shared_ptr<Worker>& worker, const RunContext& context) const;

    [[nodiscard]] const std::string& path() const { return path_; }

private:
    struct Held {
        std::shared_ptr<Worker> worker;
        std::uint64_t handle = 0;
    };
    [[nodiscard]] Held now() const;
    void renew(const Held& gone, const std::string& why, const RunContext& context) const;
    [[nodiscard]] Held load_again(std::shared_ptr<Worker> worker, const std::string& why,
                                  const RunContext& context) const;

    std::string path_;
    CadOrder order_;
    std::uint64_t digest_;
    mutable std::mutex mutex_;
    mutable Held held_; ///< under `mutex_`
};

/// A face of a loaded model.
class CadSurface final : public geometry::ExactSurface {
public:
    CadSurface(std::shared_ptr<const CadSource> source, int tag) : source_(std::move(source)), tag_(tag) {}
    void project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& context) const override;

    [[nodiscard]] const std::shared_ptr<const CadSource>& source() const { return source_; }
    [[nodiscard]] int tag() const { return tag_; } ///< in the source

private:
    std::shared_ptr<const CadSource> source_;
    int tag_;
};

/// A curve of a loaded model.
class CadCurve final : public geometry::ExactCurve, public topology::BesideLeftOut {
public:
    /// @param plain  the same curve, where it is so plain that the CAD process need not be asked.
    CadCurve(std::shared_ptr<const CadSource> source, int tag, geometry::PlainCurve plain,
             std::vector<topology::LeftOutFace> left_out)
        : source_(std::move(source)), tag_(tag), plain_(std::move(plain)), left_out_(std::move(left_out))
    {
    }
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& context) const override;

    [[nodiscard]] const std::shared_ptr<const CadSource>& source() const { return source_; }
    [[nodiscard]] int tag() const { return tag_; } ///< in the source
    [[nodiscard]] const std::vector<topology::LeftOutFace>& left_out() const override { return left_out_; }

private:
    std::shared_ptr<const CadSource> source_;
    int tag_;
    geometry::PlainCurve plain_;
    std::vector<topology::LeftOutFace> left_out_;
};

} // namespace lacuna::cad
