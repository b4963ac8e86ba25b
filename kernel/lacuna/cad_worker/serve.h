// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/shared/channel.h>

#include <functional>
#include <memory>
#include <string>

namespace lacuna::cad_worker {

/// Answer requests until the connection is closed or broken.
/// @param missing  confinement features that are missing, sent with the greeting.
/// @pre   a `Gmsh` object exists.
void serve(cad_protocol::Channel& channel, const std::string& missing);

/// Answers requests, and holds the models that earlier requests loaded.
class Desk {
public:
    Desk();
    ~Desk();
    Desk(const Desk&) = delete;
    Desk& operator=(const Desk&) = delete;

    /// @param progress  called with the fraction that is done.
    /// @return  the bytes of the reply.
    /// @throw Error, std::bad_alloc
    std::string answer(cad_protocol::Frame& request, const std::function<void(double)>& progress);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lacuna::cad_worker
