// SPDX-License-Identifier: MIT
#pragma once

// In: the processes that `mpirun` started; out: a `Crew`, on which rank 0 starts tasks and the others help.
//
// Where to change things:
//   start and end of MPI, messages between ranks  ranks.cpp
//   one file for all processes                    shared_file.cpp

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/team.h>

#include <cstddef>
#include <cstdint>
#include <memory>

/// Processes started together by `mpirun`. This folder alone needs an MPI library.
namespace lacuna::mpi {

/// Rank of this process and number of processes, from the environment; 0 of 1 without `mpirun`.
struct Place {
    int rank = 0, size = 1;
};
Place place_of_process();

/// Messages and bytes sent by this process, counted once for each receiver.
struct Traffic {
    std::size_t messages = 0;
    std::uint64_t bytes = 0;
};

/// The MPI processes, during the lifetime of this object; at most one object in each process. Rank 0 starts
/// tasks, the others help.
class Ranks {
public:
    /// Initialises MPI. Hides `mpirun` from programs that this process starts.
    Ranks();
    /// Finalises MPI. On rank 0: makes `help()` return on the other ranks.
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    [[nodiscard]] Place place() const;
    /// Number of MPI processes on this machine, including this one.
    [[nodiscard]] int on_this_machine() const;
    /// The process group that rank 0 starts tasks on.
    [[nodiscard]] const Crew& crew() const;
    /// Whether rank 0 has started a task.
    [[nodiscard]] bool were_called() const;
    [[nodiscard]] Traffic traffic() const;

    /// Take part in the tasks that rank 0 starts, until rank 0 ends. Rank 0 reports tasks that fail.
    /// @pre  the rank is not 0
    void help(const RunContext& context);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lacuna::mpi
