// SPDX-License-Identifier: MIT
#include <lacuna/cad_protocol/shared/channel.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lacuna::cad_protocol {

namespace {

constexpr std::uint32_t kMagic = 0x4443414c; // "LCAD"
constexpr std::uint16_t kVersion = 7;        // incremented with every change of a message
/// Limit on the bytes of one frame: more than the largest model that can be meshed.
constexpr std::uint64_t kMostBytes = std::uint64_t{8} << 30;

struct Head {
    std::uint32_t magic = kMagic;
    std::uint16_t version = kVersion;
    std::uint16_t opcode = 0;
    std::uint64_t descriptors = 0;
    std::uint64_t length = 0;
};
static_assert(sizeof(Head) == 24);

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

/// Take the descriptors that arrived with a part of the stream.
void collect(msghdr& message, std::vector<Descriptor>& into)
{
    for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
        if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_RIGHTS) continue;
        const std::size_t count = (c->cmsg_len - CMSG_LEN(0)) / sizeof(int);
        for (std::size_t i = 0; i < count; ++i) {
            int number = -1;
            std::memcpy(&number, CMSG_DATA(c) + i * sizeof(int), sizeof(int));
            into.emplace_back(number);
        }
    }
    if ((message.msg_flags & MSG_CTRUNC) != 0) throw ProtocolError("a frame has too many descriptors");
}

} // namespace

void Descriptor::reset(int number)
{
    if (number_ >= 0) ::close(number_);
    number_ = number;
}

Channel::Channel(Descriptor socket) : socket_(std::move(socket))
{
    ::fcntl(socket_.get(), F_SETFL, ::fcntl(socket_.get(), F_GETFL) | O_NONBLOCK);
}

void Channel::wait_for(short events, const Patience& patience)
{
    for (;;) {
        if (patience) patience();
        pollfd waiting{socket_.get(), events, 0};
        const int ready = ::poll(&waiting, 1, patience ? kTick : -1);
        if (ready > 0) return;
        if (ready < 0 && errno != EINTR) throw ChannelClosed();
    }
}

void Channel::send(Opcode opcode, std::string_view bytes, const std::vector<int>& descriptors,
                   const Patience& patience)
{
    if (descriptors.size() > kMostDescriptors) throw ProtocolError("a frame has too many descriptors");
    Head head;
    head.opcode = static_cast<std::uint16_t>(opcode);
    head.descriptors = descriptors.size();
    head.length = bytes.size();
    std::size_t sent = 0;
    while (sent < sizeof(head) + bytes.size()) {
        std::array<iovec, 2> parts{};
        std::size_t count = 0;
        if (sent < sizeof(head))
            parts[count++] = {reinterpret_cast<char*>(&head) + sent, sizeof(head) - sent};
        const std::size_t from = sent < sizeof(head) ? 0 : sent - sizeof(head);
        if (from < bytes.size())
            parts[count++] = {const_cast<char*>(bytes.data()) + from, bytes.size() - from};
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = count;
        alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostDescriptors * sizeof(int))> control{};
        if (sent == 0 && !descriptors.empty()) {
            const std::size_t size = descriptors.size() * sizeof(int);
            message.msg_control = control.data();
            message.msg_controllen = CMSG_SPACE(size);
            cmsghdr* c = CMSG_FIRSTHDR(&message);
            c->cmsg_level = SOL_SOCKET;
            c->cmsg_type = SCM_RIGHTS;
            c->cmsg_len = CMSG_LEN(size);
            std::memcpy(CMSG_DATA(c), descriptors.data(), size);
        }
        const ssize_t now = ::sendmsg(socket_.get(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (now > 0) {
            sent += static_cast<std::size_t>(now);
        } else if (now < 0 && would_block()) {
            wait_for(POLLOUT, patience);
        } else {
            throw ChannelClosed();
        }
    }
}

Frame Channel::receive(const Patience& patience)
{
    Frame frame;
    Head head;
    std::size_t got = 0;
    const auto read_into = [&](char* at, std::size_t size) {
        for (;;) {
            iovec part{at, size};
            msghdr message{};
            message.msg_iov = &part;
            message.msg_iovlen = 1;
            alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostDescriptors * sizeof(int))> control{};
            message.msg_control = control.data();
            message.msg_controllen = control.size();
            const ssize_t now = ::recvmsg(socket_.get(), &message, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
            if (now > 0) {
                collect(message, frame.descriptors);
                return static_cast<std::size_t>(now);
            }
            if (now == 0 || !would_block()) throw ChannelClosed();
            wait_for(POLLIN, patience);
        }
    };
    while (got < sizeof(head)) got += read_into(reinterpret_cast<char*>(&head) + got, sizeof(head) - got);
    if (head.magic != kMagic) throw ProtocolError("the data received is not a frame");
    if (head.version != kVersion) throw ProtocolError("the CAD process has another protocol version");
    if (head.length > kMostBytes) throw ProtocolError("a frame is too long");
    if (head.descriptors > kMostDescriptors) throw ProtocolError("a frame has too many descriptors");
    const auto length = static_cast<std::size_t>(head.length);
    got = 0;
    while (got < length) {
        if (frame.bytes.size() == got) frame.bytes.resize(std::min(length, std::max(2 * got, got + kBlock)));
        got += read_into(frame.bytes.data() + got, frame.bytes.size() - got);
    }
    if (frame.descriptors.size() != head.descriptors)
        throw ProtocolError("announced descriptors are missing");
    frame.opcode = static_cast<Opcode>(head.opcode);
    return frame;
}

} // namespace lacuna::cad_protocol
