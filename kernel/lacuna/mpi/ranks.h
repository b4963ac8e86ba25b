// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/team.h>

#include <cstddef>
#include <cstdint>
#include <memory>

/// Processes that `mpirun` started together. Needs an MPI; nothing else of the kernel does.
namespace lacuna::mpi {

/// Which of how many this process is, as the environment says; one of one where no `mpirun` started it.
struct Place {
    int rank = 0, size = 1;
};
Place place_of_process();

/// What has been sent by this process: what it had to say, once for each that got it.
struct Traffic {
    std::size_t messages = 0;
    std::uint64_t bytes = 0;
};

/// The processes, for as long as this lives; one a process. Rank 0 calls, the others help.
class Ranks {
public:
    /// Begins MPI. Programs that this one starts are not told that `mpirun` started it.
    Ranks();
    /// Ends MPI. Of rank 0: the others' `help()` returns.
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    [[nodiscard]] Place place() const;
    /// How many of them are on this machine, this one included.
    [[nodiscard]] int on_this_machine() const;
    /// The others, for rank 0 to call.
    [[nodiscard]] const Crew& crew() const;
    /// Whether they were called.
    [[nodiscard]] bool were_called() const;
    [[nodiscard]] Traffic traffic() const;

    /// Help whenever rank 0 calls, until it ends. A task that fails is rank 0's to tell of.
    /// @pre  the rank is not 0
    void help(const RunContext& context);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lacuna::mpi
