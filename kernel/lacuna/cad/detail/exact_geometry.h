// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/worker.h>
#include <lacuna/geometry/exact.h>

#include <cstdint>
#include <memory>
#include <string>

namespace lacuna::cad {

/// A model the CAD process holds, for as long as this object lives; shared by its exact curves and surfaces.
struct CadSource {
    CadSource(std::shared_ptr<Worker> worker_holding_it, std::uint64_t its_handle, std::string its_path)
        : worker(std::move(worker_holding_it)), handle(its_handle), path(std::move(its_path))
    {
    }
    ~CadSource() { worker->release(handle); }
    CadSource(const CadSource&) = delete;
    CadSource& operator=(const CadSource&) = delete;

    std::shared_ptr<Worker> worker;
    std::uint64_t handle;
    std::string path;
};

/// A face of a loaded model. Its process gone, projecting is a BackendError.
class CadSurface final : public geometry::ExactSurface {
public:
    CadSurface(std::shared_ptr<const CadSource> source, int tag) : source_(std::move(source)), tag_(tag) {}
    void project(std::span<Vec3> points, std::span<Vec2> uv) const override;

    [[nodiscard]] const std::shared_ptr<const CadSource>& source() const { return source_; }
    [[nodiscard]] int tag() const { return tag_; } ///< in the source

private:
    std::shared_ptr<const CadSource> source_;
    int tag_;
};

/// A curve of a loaded model.
class CadCurve final : public geometry::ExactCurve {
public:
    CadCurve(std::shared_ptr<const CadSource> source, int tag) : source_(std::move(source)), tag_(tag) {}
    void evaluate(std::span<const double> params, std::span<Vec3> points) const override;

    [[nodiscard]] const std::shared_ptr<const CadSource>& source() const { return source_; }
    [[nodiscard]] int tag() const { return tag_; } ///< in the source

private:
    std::shared_ptr<const CadSource> source_;
    int tag_;
};

} // namespace lacuna::cad
