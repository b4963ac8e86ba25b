// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cmath>
#include <vector>

namespace lacuna::geometry {

/// A line f0 + t f1 or an ellipse f0 + cos t f1 + sin t f2, evaluated without the CAD process.
struct PlainCurve {
    std::vector<Vec3> form; ///< f0, f1 and, for an ellipse, f2; empty: another kind of curve

    /// @pre `form` is not empty
    [[nodiscard]] Vec3 at(double t) const
    {
        if (form.size() == 2) return form[0] + t * form[1];
        return form[0] + std::cos(t) * form[1] + std::sin(t) * form[2];
    }
};

} // namespace lacuna::geometry
