// SPDX-License-Identifier: GPL-2.0-or-later
/// lacuna-cad: Gmsh and Open CASCADE in a separate process. The kernel starts it with a socket as descriptor
/// 3, on which it receives requests and sends replies; it ends when the socket is closed.
#include <lacuna/cad_protocol/shared/channel.h>
#include <lacuna/cad_worker/confine.h>
#include <lacuna/cad_worker/serve.h>
#include <lacuna/cad_worker/session.h>

#include <csignal>
#include <thread>

#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

/// Largest file that may be written [bytes]: more than any solid, less than a disk.
constexpr rlim_t kLargestFile = rlim_t{4} << 30;

/// End when the host ends, even during a request that never returns.
void watch_host(pid_t host)
{
    for (;;) {
        pollfd socket{lacuna::cad_protocol::kSocket, POLLRDHUP, 0};
        // The parent is checked too, because a forked child of the host may keep the socket open.
        ::poll(&socket, 1, lacuna::cad_protocol::kTick);
        if ((socket.revents & (POLLRDHUP | POLLHUP | POLLERR | POLLNVAL)) != 0 || ::getppid() != host)
            ::_exit(0);
    }
}

} // namespace

int main()
{
    int type = 0;
    socklen_t size = sizeof(type);
    if (::getsockopt(lacuna::cad_protocol::kSocket, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
        constexpr std::string_view kWords =
            "lacuna-cad is started by Lacuna to read a CAD file; do not start it by hand\n";
        return ::write(2, kWords.data(), kWords.size()) < 0 ? 2 : 1;
    }
    ::syscall(SYS_close_range, lacuna::cad_protocol::kSocket + 1, ~0U,
              0); // close descriptors that the host left open
    const rlimit no_core{0, 0}, file{kLargestFile, kLargestFile};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::setrlimit(RLIMIT_FSIZE, &file);
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the limit then fails instead of ending the process
    std::signal(SIGPIPE, SIG_IGN);
    const pid_t host = ::getppid();
    using namespace lacuna;
    cad_protocol::Channel channel{cad_protocol::Descriptor(lacuna::cad_protocol::kSocket)};
    try {
        cad_worker::keep_from_writing();
        const cad_worker::Gmsh gmsh;
        const std::string missing = cad_worker::confine();
        std::thread(watch_host, host).detach();
        cad_worker::serve(channel, missing);
    } catch (const Error& error) {
        using namespace cad_protocol;
        try {
            channel.send(Opcode::failed, encode(Failure{Failure::backend, error.message().parts()}));
        } catch (const Error&) { // The connection is closed.
        }
    } catch (...) {
        ::_exit(1);
    }
    // Skip destructors, because libraries may be in an undefined state.
    ::_exit(0);
}
