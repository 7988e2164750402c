/// @file
/// KiCad's files: lists in brackets, of words, quoted texts and lists. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

/// A text as these files have it.
[[nodiscard]] std::string quoted_text(std::string_view text);

/// One list, its parts in order. Read once, without recursion: no file exhausts the stack.
class SExpression {
  static constexpr auto none = static_cast<std::size_t>(-1);
  struct Node {
    std::string_view text{};  // of a word, and of a text with its quotes
    std::size_t first = none, next = none;
    std::size_t line = 1;
    bool list = false;
  };

 public:
  /// The text must outlive the object.
  ///
  /// @param file  in messages
  /// @throw std::invalid_argument  no list, an unclosed list or text, text behind the list, or
  ///                               lists nested deeper than any of KiCad's
  SExpression(std::string_view text, std::string file);

  /// A word, a text or a list.
  class Item {
   public:
    Item(const SExpression& of, std::size_t at) : of_(&of), at_(at) {}

    [[nodiscard]] bool is_list() const { return node().list; }
    /// A list's first word; empty: it begins with none.
    [[nodiscard]] std::string_view head() const;
    /// The k-th part behind the head of a list.
    /// @throw std::invalid_argument  there is none
    [[nodiscard]] Item part(std::size_t k) const;
    [[nodiscard]] std::optional<Item> find_part(std::size_t k) const;
    /// Of a list: calls `call(item)` for every list inside that begins with `name`, or for every
    /// one where the name is empty.
    void each(std::string_view name, const auto& call) const {
      for (std::size_t at = node().first; at != none; at = of_->nodes_[at].next) {
        const Item item(*of_, at);
        if (item.is_list() && (name.empty() || item.head() == name)) call(item);
      }
    }
    /// The same for every part behind the head, a word or a list.
    void each_part(const auto& call) const {
      if (node().first == none) return;
      for (std::size_t at = of_->nodes_[node().first].next; at != none; at = of_->nodes_[at].next)
        call(Item(*of_, at));
    }
    /// The first of these; absent: there is none.
    [[nodiscard]] std::optional<Item> find(std::string_view name) const;
    /// @throw std::invalid_argument  there is none
    [[nodiscard]] Item get(std::string_view name) const;

    /// A word, or a text without its quotes. @throw std::invalid_argument  a list
    [[nodiscard]] std::string text() const;
    /// @throw std::invalid_argument  no finite number
    [[nodiscard]] double number() const;
    /// @throw std::invalid_argument  no whole number from 0 to below the limit
    [[nodiscard]] std::size_t index(std::size_t limit) const;

    /// "board.kicad_pcb:12: message".
    [[noreturn]] void refuse(const std::string& message) const;
    [[nodiscard]] std::size_t line() const { return node().line; }

   private:
    [[nodiscard]] const Node& node() const { return of_->nodes_[at_]; }

    const SExpression* of_;
    std::size_t at_;
  };

  [[nodiscard]] Item root() const { return {*this, 0}; }

 private:
  [[noreturn]] void refuse(std::size_t line, const std::string& message) const;

  std::string file_;
  std::vector<Node> nodes_;
};

}  // namespace tactile_net
