// SPDX-License-Identifier: MIT
#include <lacuna/mpi/ranks.h>

#include <lacuna/mpi/detail/shared_file.h>
#include <lacuna/team/shared/tasks.h>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace lacuna::mpi {
namespace {

using namespace std::chrono_literals;

// Requests are polled with pauses, because MPI itself waits in a busy loop, which takes a core from working
// processes.
constexpr std::chrono::microseconds kShortest = 20us,
                                    kLongest = 2ms; // short compared with a task, which takes 0.1 s or more

void wait(MPI_Request request)
{
    for (std::chrono::microseconds pause = kShortest;;
         pause = std::min<std::chrono::microseconds>(2 * pause, kLongest)) {
        int done = 0;
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done != 0) return;
        std::this_thread::sleep_for(pause);
    }
}

/// Broadcast bytes whose number all processes know.
void broadcast(char* bytes, std::size_t count, int from)
{
    for (std::size_t at = 0; at < count; at += kMostAtOnce) {
        MPI_Request request;
        MPI_Ibcast(bytes + at, static_cast<int>(std::min(kMostAtOnce, count - at)), MPI_BYTE, from,
                   MPI_COMM_WORLD, &request);
        wait(request);
    }
}

struct Names {
    const char *rank, *size;
};
/// Environment variables of Open MPI, and of launchers that use PMI.
constexpr std::array<Names, 2> kNames{
    {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}}};

} // namespace

Place place_of_process()
{
    for (const Names& names : kNames) {
        const char *rank = std::getenv(names.rank), *size = std::getenv(names.size);
        if (rank != nullptr && size != nullptr) return {std::atoi(rank), std::max(1, std::atoi(size))};
    }
    return {};
}

struct Ranks::State {
    Place place;
    int here = 1;
    Team team;
    Crew crew;
    Traffic traffic;
    bool called = false;

    void count(std::size_t bytes)
    {
        const auto others = static_cast<std::size_t>(place.size - 1);
        traffic.messages += others;
        traffic.bytes += bytes * others;
    }

    std::vector<std::string> exchange(const std::string& own)
    {
        count(own.size());
        const auto size = static_cast<std::size_t>(place.size);
        const std::uint64_t length = own.size();
        std::vector<std::uint64_t> lengths(size);
        MPI_Request request;
        MPI_Iallgather(&length, 1, MPI_UINT64_T, lengths.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request);
        wait(request);
        std::vector<std::string> all(size);
        for (int rank = 0; rank < place.size; ++rank) {
            std::string& bytes = all[static_cast<std::size_t>(rank)];
            if (rank == place.rank)
                bytes = own;
            else
                bytes.resize(lengths[static_cast<std::size_t>(rank)]);
            broadcast(bytes.data(), bytes.size(), rank);
        }
        return all;
    }

    /// Send a task from rank 0 to the others. An empty name makes their `help()` return.
    void hand_out(std::string& task, std::string& bytes)
    {
        std::array<std::uint64_t, 2> lengths{task.size(), bytes.size()};
        if (place.rank == 0) count(task.size() + bytes.size());
        broadcast(reinterpret_cast<char*>(lengths.data()), sizeof lengths, 0);
        task.resize(lengths[0]);
        bytes.resize(lengths[1]);
        broadcast(task.data(), task.size(), 0);
        broadcast(bytes.data(), bytes.size(), 0);
    }
};

Ranks::Ranks() : state_(std::make_unique<State>())
{
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    State& state = *state_;
    MPI_Comm_rank(MPI_COMM_WORLD, &state.place.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &state.place.size);
    MPI_Comm here;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &state.here);
    MPI_Comm_free(&here);
    for (const Names& names : kNames) unsetenv(names.rank), unsetenv(names.size);

    state.team.rank = state.place.rank;
    state.team.size = state.place.size;
    state.team.one_machine = state.here == state.place.size;
    state.team.exchange = [&state](const std::string& own) { return state.exchange(own); };
    state.team.open = open_shared;
    state.crew.size = state.place.size;
    state.crew.call = [&state](std::string_view task, const std::string& bytes) -> const Team& {
        std::string name(task), all = bytes;
        state.called = true;
        state.hand_out(name, all);
        return state.team;
    };
}

Ranks::~Ranks()
{
    std::string none, nothing;
    if (state_->place.rank == 0) state_->hand_out(none, nothing);
    MPI_Finalize();
}

Place Ranks::place() const { return state_->place; }
int Ranks::on_this_machine() const { return state_->here; }
const Crew& Ranks::crew() const { return state_->crew; }
bool Ranks::were_called() const { return state_->called; }
Traffic Ranks::traffic() const { return state_->traffic; }

void Ranks::help(const RunContext& context)
{
    for (;;) {
        std::string task, bytes;
        state_->hand_out(task, bytes);
        if (task.empty()) return;
        try {
            team::help(task, bytes, state_->team, context);
        } catch (const std::exception&) {
            // rank 0 reports the failure
        }
    }
}

} // namespace lacuna::mpi
