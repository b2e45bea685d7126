// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to ranks: messages between ranks, as the module of MPI brings them.
#ifndef CELLWALK_RANKS_TRANSPORT_H
#define CELLWALK_RANKS_TRANSPORT_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace cellwalk {

/// The content of a message of a rank to the first, or of the first to a rank.
enum class Message_kind : std::uint64_t { part, failure, farewell };
struct Message {
  Message_kind kind = Message_kind::part;
  std::string bytes;
};

/// Messages between ranks. Whoever waits sleeps in between, and calls `check`.
class Transport {
 public:
  Transport() = default;
  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  virtual std::size_t rank() const = 0;
  virtual std::size_t size() const = 0;

  /// Sends a message, in the order of calls. Returns at once, unless many earlier ones are still on their
  /// way.
  virtual void send(std::size_t to, Message message) = 0;
  /// Gives up messages that were sent, and nobody will receive.
  virtual void drop_sent() = 0;
  /// The next message that a rank sent to this one.
  virtual Message receive(std::size_t from) = 0;
  /// The bytes of the first rank, on every rank.
  virtual std::string broadcast(std::string bytes) = 0;
  /// The same among the ranks that share the memory of a node.
  virtual std::string broadcast_on_node(std::string bytes) = 0;
  virtual std::size_t rank_on_node() const = 0;
  virtual std::size_t size_of_node() const = 0;
  /// Ends all ranks.
  [[noreturn]] virtual void end(int exit_code) = 0;
};

/// The description of the module.
struct Transport_module {
  const char* cellwalk;  ///< the version of Cellwalk that it belongs to
  std::string (*library)();
  std::unique_ptr<Transport> (*join)();
};

/// The name of the function by which the module returns its description.
inline constexpr const char* transport_module_entry = "cellwalk_transport_module";
using Transport_module_entry = const Transport_module* (*)();

}  // namespace cellwalk

#endif  // CELLWALK_RANKS_TRANSPORT_H
