// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/channel.h>

#include <functional>
#include <memory>
#include <string>

namespace lacuna::cad_worker {

/// Answer requests until the other side goes or says what is no frame.
/// @param missing  what the confinement lacks, told in the greeting.
/// @pre   a `Gmsh` lives.
void serve(cad_protocol::Channel& channel, const std::string& missing);

/// Answer one request; what the models of the requests before are is kept by the object.
class Desk {
public:
    Desk();
    ~Desk();
    Desk(const Desk&) = delete;
    Desk& operator=(const Desk&) = delete;

    /// @param progress  told the share that is done.
    /// @return  the bytes of the reply.
    /// @throw Error, std::bad_alloc
    std::string answer(cad_protocol::Frame& request, const std::function<void(double)>& progress);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lacuna::cad_worker
