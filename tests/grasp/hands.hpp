/// @file
/// Random hands, and their statics computed a second way: complex numbers for the geometry, moments
/// about the palm's origin, differences of the kinematics for what moves.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/grasp/finger.hpp"
#include "tactile_net/grasp/finger_action.hpp"
#include "tactile_net/grasp/fingertip_force.hpp"

namespace tactile_net {

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  double sign() { return generator_() % 2 == 0 ? 1.0 : -1.0; }
  double normal() { return std::normal_distribution<double>()(generator_); }

 private:
  std::mt19937 generator_;
};

/// A hand with contacts at y*, none of its fingers straight.
struct Hand {
  std::vector<Finger> fingers{};
  std::vector<ContactPlace> contacts{};
  ExternalLoad load{};
};

inline Hand random_hand(Random& random, std::size_t fingers, std::size_t joints) {
  Hand hand;
  for (std::size_t i = 0; i < fingers; ++i) {
    Finger finger;
    finger.name = "finger " + std::to_string(i);
    finger.base = {random.between(-4.0, 4.0), random.between(-1.0, 1.0)};
    finger.direction = random.between(-3.0, 3.0);
    for (std::size_t j = 0; j < joints; ++j) {
      finger.links.push_back(random.between(1.0, 4.0));
      finger.angles.push_back(random.sign() * random.between(0.5, 2.2));
    }
    finger.pad = {.center = random.between(0.3, 1.0),
                  .height = random.between(-0.2, 0.2),
                  .tilt = random.between(-0.3, 0.3),
                  .half_width = 0.4,
                  .side = random.sign() > 0.0 ? Side::left : Side::right,
                  .reversed = random.sign() > 0.0};
    hand.fingers.push_back(finger);
    hand.contacts.push_back({random.between(-0.4, 0.4), 0.0});
  }
  hand.load = {{random.between(-3.0, 3.0), random.between(-3.0, 3.0)},
               random.between(-5.0, 5.0),
               {random.between(-3.0, 3.0), random.between(-3.0, 3.0)}};
  return hand;
}

using Complex = std::complex<double>;

inline Complex complex_of(Vector2 v) { return {v.x, v.y}; }
/// Moment of b at a.
inline double moment(Complex a, Complex b) { return (std::conj(a) * b).imag(); }

/// Joints and contact by rotations of the complex plane.
struct Placed {
  std::vector<Complex> joints{};
  Complex contact{};
};

inline Placed placed(const Finger& finger, double y) {
  Placed result;
  Complex end = complex_of(finger.base);
  Complex turn = std::polar(1.0, finger.direction);
  for (std::size_t i = 0; i < finger.links.size(); ++i) {
    result.joints.push_back(end);
    turn *= std::polar(1.0, finger.angles[i]);
    end += finger.links[i] * turn;
  }
  const double side = finger.pad.side == Side::left ? 1.0 : -1.0;
  result.contact = result.joints.back() +
                   turn * (Complex{finger.pad.center, side * finger.pad.height} +
                           (finger.pad.reversed ? -y : y) * std::polar(1.0, finger.pad.tilt));
  return result;
}

/// The same hand in a palm's frame that is turned and moved.
inline Hand moved(Hand hand, double angle, Complex by) {
  const Complex turn = std::polar(1.0, angle);
  const auto move = [&](Vector2 v, Complex shift) {
    const Complex image = turn * complex_of(v) + shift;
    return Vector2{image.real(), image.imag()};
  };
  for (Finger& finger : hand.fingers) {
    finger.base = move(finger.base, by);
    finger.direction += angle;
  }
  hand.load.force = move(hand.load.force, 0.0);
  hand.load.point = move(hand.load.point, by);
  return hand;
}

/// The mirror image across the Y axis.
inline Hand mirrored(Hand hand) {
  for (Finger& finger : hand.fingers) {
    finger.base.x = -finger.base.x;
    finger.direction = std::numbers::pi - finger.direction;
    for (double& angle : finger.angles) angle = -angle;
    finger.pad.tilt = -finger.pad.tilt;
    finger.pad.side = finger.pad.side == Side::left ? Side::right : Side::left;
  }
  hand.load.force.x = -hand.load.force.x;
  hand.load.point.x = -hand.load.point.x;
  hand.load.torque = -hand.load.torque;
  return hand;
}

/// In other units: every length and every force multiplied.
inline Hand scaled(Hand hand, double lengths, double forces) {
  for (Finger& finger : hand.fingers) {
    finger.base = lengths * finger.base;
    for (double& link : finger.links) link *= lengths;
    finger.pad.center *= lengths;
    finger.pad.height *= lengths;
    finger.pad.half_width *= lengths;
  }
  for (ContactPlace& contact : hand.contacts) {
    contact.centre *= lengths;
    contact.deviation *= lengths;
  }
  hand.load.force = forces * hand.load.force;
  hand.load.point = lengths * hand.load.point;
  hand.load.torque *= lengths * forces;
  return hand;
}

inline double largest(std::span<const double> values) {
  double size = 0.0;
  for (const double value : values) size = std::fmax(size, std::abs(value));
  return size;
}

/// What is left of the balance, over the size of what was added up.
inline double unbalance(const Hand& hand, const std::vector<Complex>& forces) {
  Complex sum = complex_of(hand.load.force);
  double turn = hand.load.torque + moment(complex_of(hand.load.point), sum);
  double size = std::abs(sum) + std::abs(turn);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double one = moment(placed(hand.fingers[i], hand.contacts[i].centre).contact, forces[i]);
    sum += forces[i];
    turn += one;
    size += std::abs(forces[i]) + std::abs(one);
  }
  return (std::abs(sum) + std::abs(turn)) / size;
}

}  // namespace tactile_net
