// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad_protocol/shared/messages.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lacuna::cad_protocol {

/// Number of the CAD process's end of the connection among its descriptors.
inline constexpr int kSocket = 3;
/// Limit on the descriptors of one frame, and so on the files of a request; Linux allows 253.
inline constexpr std::size_t kMostDescriptors = 250;
/// Bytes that are copied, sent or allocated at once.
inline constexpr int kBlock = 1 << 20;
/// Pause between two looks at the other process, and between two reports of progress: a person notices no
/// shorter one [ms].
inline constexpr int kTick = 50;

/// A file descriptor that is closed with the object.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { reset(); }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        if (this != &other) reset(std::exchange(other.number_, -1));
        return *this;
    }
    [[nodiscard]] int get() const { return number_; }
    [[nodiscard]] int release() { return std::exchange(number_, -1); }
    [[nodiscard]] explicit operator bool() const { return number_ >= 0; }
    void reset(int number = -1);

private:
    int number_ = -1;
};

/// The other process has closed its end of the socket.
class ChannelClosed : public ProtocolError {
public:
    ChannelClosed() : ProtocolError("the connection was closed") {}
};

struct Frame {
    Opcode opcode = Opcode::done;
    std::string bytes;
    std::vector<Descriptor> descriptors;
};

/// One end of a stream socket that transports whole frames, optionally with file descriptors.
///
/// A frame is a header of 24 bytes (magic, version, opcode, number of descriptors, length) and its payload.
/// Lengths and numbers of descriptors are not trusted: memory is allocated as bytes arrive.
class Channel {
public:
    /// Called at least every 50 ms while the channel waits. May throw to give up; the channel must not be
    /// used after that.
    using Patience = std::function<void()>;

    explicit Channel(Descriptor socket);

    /// @throw ChannelClosed. SIGPIPE is not raised.
    void send(Opcode opcode, std::string_view bytes, const std::vector<int>& descriptors = {},
              const Patience& patience = {});
    /// @throw ChannelClosed, ProtocolError.
    Frame receive(const Patience& patience = {});

    [[nodiscard]] int socket() const { return socket_.get(); }

private:
    void wait_for(short events, const Patience& patience);

    Descriptor socket_;
};

} // namespace lacuna::cad_protocol
