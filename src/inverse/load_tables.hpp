/// @file
/// What a mixture of loads knows before anything is read: its windows, and of each with each
/// tangential weight a decomposition. Private.
///
/// Of windows that are images of one another on an array that is its own, with y or z reflected or
/// the two exchanged, one is decomposed: for the others the readings are reflected instead. A
/// window that is its own image is decomposed class by class. What only answers need is made when a
/// frame finds a window likely.
///
/// Of many readings no singular vectors are worked out: what tells how likely a window is, and what
/// it then knows of tractions, a bidiagonal matrix gives as exactly (damped_bidiagonal.hpp), at a
/// tenth of the time. No answer depends on what was worked out before.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "inverse/damped_bidiagonal.hpp"
#include "inverse/mirror_classes.hpp"
#include "inverse/weighting.hpp"
#include "inverse/window_places.hpp"
#include "numeric/bidiagonalisation.hpp"
#include "numeric/decompositions.hpp"
#include "tactile_net/inverse/load_mixture.hpp"

namespace tactile_net {

/// Of the windows of a mixture: steps as small as what little noise leaves of where a load ends.
/// Of two unknowns, of many readings or of a skin, whose frames take longer, they are larger.
[[nodiscard]] WindowSteps mixture_steps(const LinearProblem& problem, double depth);

/// T of a window, f = T c with |c|^2 the stabiliser: waves that end where the window does, each
/// over what (1 + (d/2)^2 Q) stretches it by.
class WindowCoordinates {
 public:
  WindowCoordinates(const LinearProblem& problem, const WindowPlace& place, double depth);

  /// Of one component.
  [[nodiscard]] Eigen::Index count() const noexcept { return sizes_.size(); }
  /// T c of one component, column by column.
  [[nodiscard]] Eigen::MatrixXd tractions(const Eigen::Ref<const Eigen::MatrixXd>& c) const;
  /// T' f.
  [[nodiscard]] Eigen::MatrixXd sums(const Eigen::Ref<const Eigen::MatrixXd>& f) const;
  /// Of a square window's components one after another, a row each: turns what an exchange of y and
  /// z makes of each other into their sum and their difference.
  void part_exchanged(Eigen::Ref<Eigen::MatrixXd> c) const;
  /// The squares of each value: the diagonal of T T'.
  [[nodiscard]] Eigen::VectorXd squares() const;

 private:
  Eigen::MatrixXd y_, z_;
  Eigen::VectorXd sizes_;
};

struct LoadPrior::Tables {
  /// Of the alphas those at which every window is looked at: each fourth, the first one too.
  static constexpr int looked_apart = 4;
  static constexpr std::size_t few_readings = 128;
  /// Windows with a weight that answer for a frame of many readings. Contacts make fewer likely; of
  /// a frame of noise alone forces' bands are within a tenth of what all windows say, cells' mostly
  /// within a sixth.
  static constexpr std::size_t most_windows = 64;

  /// Of readings and of tractions: y -> -y, z -> -z, both or none, and then y and z exchanged or
  /// not.
  struct Reflection {
    std::vector<Eigen::Index> readings{};   // the one that each becomes
    Eigen::VectorXd signs{};                // of each
    std::vector<std::size_t> components{};  // of the tractions, the one that each becomes
    std::vector<double> tractions{};        // the sign of each
    bool of_y = false, of_z = false, exchanged = false;

    [[nodiscard]] WindowPlace image(const WindowPlace& place, const SurfaceGrid& grid) const;
  };
  struct Range;
  /// One of the windows that are each other's images.
  struct Shape {
    WindowCoordinates coordinates;
    double log_prior = 0.0;               // of each of its windows
    std::vector<std::size_t> own{};       // reflections that leave it where it is
    std::vector<Eigen::Index> columns{};  // of K: the window's values, of each component
    std::size_t first = 0;                // entry of the least weight, those of the others follow
    /// Of the entries and of the alphas from each that is looked at up to the next, which is
    /// larger.
    Eigen::VectorXd most_log_prior{};
    /// Of few readings and of the least weight alpha / (gamma^2 + alpha), a row for each alpha that
    /// is looked at.
    Eigen::MatrixXd looks{};
    std::vector<std::size_t> windows{};
    std::shared_ptr<const Range> range{};  // where there are outlines
  };
  /// Where a load may lie, with whatever tangential weight.
  struct Window {
    std::size_t shape = 0;
    std::size_t reflection = 0;           // that makes the shape's window of it
    std::vector<Eigen::Index> columns{};  // of K, the images of the shape's one after another
  };
  /// Of a shape and a weight.
  struct Entry {
    std::size_t shape = 0;
    double tangential_weight = 1.0;
    Eigen::VectorXd log_prior{};  // of each alpha, with the log of det(I - H)^(1/2)
    Eigen::VectorXd used{};       // of each alpha, tr H
    // Of few readings K T = U diag(gamma) V'.
    Eigen::MatrixXd u{};
    Eigen::VectorXd gamma{}, gamma2{};
  };
  /// The readings that a shape shows in, class by class: orthonormal columns.
  struct Range {
    std::vector<Eigen::SparseMatrix<double>> classes{};  // none: all of them
    /// Of each class, where fewer values than readings are in it, what these can show, a column
    /// each; of the shape, not of a weight.
    std::vector<Eigen::MatrixXd> within{};
    struct Coordinates {
      Eigen::MatrixXd within{};      // class after class
      Eigen::RowVectorXd outside{};  // the squares of what no traction explains
    };
    /// @param readings  a column a frame
    [[nodiscard]] Coordinates coordinates(const Eigen::MatrixXd& readings) const;
  };
  /// Of a shape and a weight, class by class: K T = U B V', B bidiagonal.
  struct Outline {
    std::vector<Bidiagonalisation> classes{};  // over a power of two
    std::vector<Eigen::MatrixXd> u{};          // of each class; of the least weight alone
    Eigen::VectorXd diagonal{}, above{};       // of B, with 0 between two classes
    std::optional<DampedBidiagonal> looks{};   // of the least weight: alphas that are looked at

    /// U'x. @param x  coordinates of the range
    [[nodiscard]] Eigen::MatrixXd rotated(const Eigen::MatrixXd& x) const;
    [[nodiscard]] DampedBidiagonal damped(Eigen::VectorXd by) const {
      return {diagonal, above, std::move(by)};
    }
  };
  /// What answers need of an entry.
  struct Details {
    Eigen::MatrixXd v{};       // of an outline that hides nothing: not kept
    Eigen::MatrixXd roots{};   // T V, a row a value
    Eigen::VectorXd hidden{};  // the squares of what no reading shows of each value
    /// Of each alpha, of an outline, what the noise leaves of each value: kept when it is made.
    mutable std::vector<Eigen::VectorXd> spreads{};
    mutable std::mutex mutex{};
  };

  /// @param least_parted  readings: of fewer a decomposition takes a millisecond, as a thread does,
  ///                      and is neither parted into classes nor given one, nor outlined
  Tables(const LinearProblem& problem, const LoadPriorOptions& options,
         std::size_t least_parted = few_readings);
  /// Of these no more than the windows, which say how much work the rest is.
  struct WindowsAlone {};
  Tables(const LinearProblem& problem, const LoadPriorOptions& options, WindowsAlone);
  [[nodiscard]] LoadWork work() const;

  [[nodiscard]] std::size_t entries_count() const noexcept { return entries_.size(); }
  [[nodiscard]] const Entry& entry(std::size_t at) const { return entries_[at]; }
  /// Whether there are outlines, and no singular vectors.
  [[nodiscard]] bool is_long() const noexcept { return is_long_; }
  /// The alphas at which every window is looked at.
  [[nodiscard]] Eigen::VectorXd looked_at() const {
    return alphas(Eigen::seq(Eigen::Index{0}, alphas.size() - 1, Eigen::fix<looked_apart>));
  }
  /// @pre  is_long()
  [[nodiscard]] const Outline& outline(std::size_t at) const { return outlines_[at]; }
  [[nodiscard]] std::size_t index_of(const Entry& entry) const {
    return static_cast<std::size_t>(&entry - entries_.data());
  }

  /// Of a frame's part what each of its sizes filters U'g to, a column each: times `roots` the
  /// mean.
  [[nodiscard]] Eigen::MatrixXd filtered(const Part& part) const;
  /// Of each sum of V, a row each, what noise of 1 leaves, a column a size.
  [[nodiscard]] Eigen::MatrixXd spreads(const Part& part, const Eigen::MatrixXd& sums) const;
  /// Of each value. @param details  of the part's entry
  [[nodiscard]] Eigen::MatrixXd spreads(const Part& part, const Details& details) const;
  /// Of two sums what they share.
  [[nodiscard]] Eigen::RowVectorXd products(const Part& part, const Eigen::RowVectorXd& a,
                                            const Eigen::RowVectorXd& b) const;

  /// Kept as long as there is room: those that were asked for longest ago go. Several threads may
  /// ask.
  [[nodiscard]] std::shared_ptr<const Details> details(const Entry& entry) const;

  /// T c of all components: the tangential ones are as much smaller as they weigh more.
  [[nodiscard]] Eigen::MatrixXd tractions(const Entry& entry, const Eigen::MatrixXd& c) const;
  /// T' f.
  [[nodiscard]] Eigen::MatrixXd sums(const Entry& entry, const Eigen::MatrixXd& f) const;

  /// What a window holds of these columns of values, as its shape has it.
  [[nodiscard]] Eigen::MatrixXd inside(const Window& window, const Eigen::MatrixXd& all) const;
  /// Adds a shape's values to all.
  void add(const Window& window, const Eigen::VectorXd& inside,
           Eigen::Ref<Eigen::VectorXd> all) const;

  /// How many numbers are kept.
  [[nodiscard]] std::size_t numbers() const {
    const std::lock_guard lock(mutex_);
    return numbers_;
  }

  [[nodiscard]] Eigen::Index tractions_count() const noexcept { return components * block; }

  Weighting weighting;
  Eigen::Index components;
  Eigen::Index block;  // values of a component
  Eigen::VectorXd alphas{};
  std::vector<double> tangential_weights{};  // ascending
  std::size_t most_components;               // that answer, of few readings
  std::vector<Reflection> reflections{};     // none first
  std::vector<Shape> shapes{};
  std::vector<Window> windows{};             // the whole surface first
  std::size_t room = std::size_t{32} << 20;  // numbers of details: 256 MB

 private:
  void find_reflections(const LinearProblem& problem);
  void add_windows(const LinearProblem& problem, const LoadPriorOptions& options);
  /// Columns of K, of a shape's values as they lie in the window.
  [[nodiscard]] std::vector<Eigen::Index> columns_of(const LinearProblem& problem,
                                                     const WindowPlace& place,
                                                     const Reflection& by) const;
  /// The whole surface, which sizes alphas, and then shape after shape by whoever is free.
  void prepare(std::size_t threads);
  /// Rows of T'K': as many as readings are enough.
  struct Rows {
    std::vector<Eigen::Index> kept{};   // of all; others are nothing but rounding
    std::optional<HouseholderQr> qr{};  // of these, where they are more
    Eigen::MatrixXd seen{};             // a column a reading
    /// Of all the rows. @param x  of those seen
    [[nodiscard]] Eigen::MatrixXd back(const Eigen::MatrixXd& x, Eigen::Index all) const;
  };
  /// A shape's values as the readings show them, of weight 1, over a power of two.
  struct Shown {
    double size = 1.0;
    std::vector<Eigen::SparseMatrix<double>> classes{};
    std::vector<Rows> normal{}, tangential{};  // of each class
  };
  [[nodiscard]] Shown shown(const Shape& shape) const;
  [[nodiscard]] Entry decomposed(std::size_t at) const;
  void outline_all(std::size_t of);
  void size_alphas(double largest_gamma);
  /// Leaves out what no reading shows, and adds what is known of it before anything is read.
  void weigh(Entry& entry) const;
  [[nodiscard]] double log_prior(const Shape& shape, double tangential_weight,
                                 Eigen::Index a) const;
  /// Of the reflections that leave a shape where it is those by which it is parted into classes.
  [[nodiscard]] std::vector<const Reflection*> classifying(const Shape& shape) const;
  /// Combinations of readings, orthonormal columns: no traction of the shape mixes two classes.
  [[nodiscard]] std::vector<Eigen::SparseMatrix<double>> classes_by(
      std::span<const Reflection* const> by) const;
  /// T, V and what they hide.
  void make(const Entry& entry, Details& made) const;
  /// 1 / (gamma^2 + alpha), a column for each size.
  [[nodiscard]] static Eigen::MatrixXd over(const Part& part);
  [[nodiscard]] Eigen::MatrixXd value_vectors(const Entry& entry) const;
  /// The same of an outline.
  [[nodiscard]] Eigen::MatrixXd outlined_vectors(std::size_t at) const;
  /// T or T' of each component, over its weight.
  [[nodiscard]] Eigen::MatrixXd of_components(const Entry& entry, const Eigen::MatrixXd& values,
                                              auto map) const;

  Eigen::MatrixXd kernel_;
  double prior_power_;
  bool is_long_;
  std::vector<Outline> outlines_{};  // of each entry; of few readings none
  std::vector<Entry> entries_{};
  mutable std::mutex mutex_{};
  mutable std::vector<std::shared_ptr<const Details>> kept_{};  // of each entry
  mutable std::vector<std::size_t> asked_{};                    // when it was asked for
  mutable std::size_t asks_ = 0;
  mutable std::size_t numbers_ = 0;  // of those that are kept
};

/// What a frame makes of a window with one weight.
struct LoadPrior::Part {
  const Tables::Entry* entry = nullptr;
  const Tables::Window* window = nullptr;
  Eigen::VectorXd beta{};  // U'g over sigma
  struct Size {
    Eigen::Index at = 0;  // which alpha
    double alpha = 0.0;
    double probability = 0.0;
    double scale2 = 1.0;  // of variances: (nu + q) / (nu + rows)
  };
  std::vector<Size> sizes{};                 // those that are likely
  std::optional<DampedBidiagonal> damped{};  // by them, where there are outlines

  [[nodiscard]] Eigen::VectorXd alphas() const {
    Eigen::VectorXd all(std::ssize(sizes));
    for (Eigen::Index i = 0; i < all.size(); ++i) all(i) = sizes[static_cast<std::size_t>(i)].alpha;
    return all;
  }
};

/// A probability that is left out.
inline constexpr double unlikely = 1e-6;

/// The likely components of a frame, found without a look at most of the others: probabilities
/// that sum to 1, window after window.
///
/// @param g      readings over sigma
/// @param known  nu
/// @param least  q is not less
/// @param most   > 0: components, of many readings windows with a weight; where more are likely so
///               many stand for all
[[nodiscard]] std::vector<LoadPrior::Part> likely_parts(
    const LoadPrior::Tables& tables, const Eigen::VectorXd& g, double known, double least,
    std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace tactile_net
