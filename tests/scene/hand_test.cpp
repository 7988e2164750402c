// Hand files: what is read, and what is refused at its place.
#include "tactile_net/scene/hand.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>
#include <string>

#include "tactile_net/scene/space_hand.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;

const std::string good_hand = R"(title = "A hand"
angles_in = "degrees"

[load]
force = [0.5, -4.9]
point = [0.0, 0.08]
torque = 0.1

[grasp]
grasping_force = 12.0
friction = 0.6
friction_used = 0.9

[[finger]]
name = "left"
base = [-0.03, 0.0]
direction = 90
links = [0.05, 0.04]
angles = [30, -45]
torque_limits = [0.5, 0.3]
pad = { center = 0.02, height = 0.005, half_width = 0.01, side = "right", tilt = 5, breadth = 0.02 }
contact = { normal = 7.0, tangential = 1.0, center = 0.002, normal_deviation = 0.1 }

[[finger]]
name = "right"
base = [0.03, 0.0]
direction = 90
links = [0.05, 0.04]
angles = [-30, 45]
friction = 0.4
pad = { center = 0.02, half_width = 0.01, side = "left", reversed = true }
contact = { center = 0.0, center_deviation = 1e-3 }
)";

Hand parsed_hand(const std::string& toml) { return parse_hand(toml, "folder/hand.toml"); }

/// The good hand with one thing put in another's place is refused there, with that message.
void check(const std::string& from, const std::string& to, const std::string& place,
           const std::string& message) {
  std::string toml = good_hand;
  const std::size_t at = toml.find(from);
  REQUIRE(at != std::string::npos);
  toml.replace(at, from.size(), to);
  CAPTURE(from, to);
  try {
    (void)parsed_hand(toml);
    FAIL_CHECK("the hand was read");
  } catch (const InputError& error) {
    const Diagnostic& first = error.diagnostics().front();
    CHECK(std::to_string(first.line) + ':' + std::to_string(first.column) == place);
    CHECK_THAT(text(first), ContainsSubstring(message));
  }
}

}  // namespace

TEST_CASE("a hand is read as it stands, angles in radians", "[hand]") {
  const Hand hand = parsed_hand(good_hand);
  CHECK(hand.file == "hand.toml");
  CHECK(hand.folder == "folder");
  CHECK(hand.title == "A hand");
  REQUIRE(hand.load.has_value());
  CHECK(hand.load->force.y == -4.9);
  CHECK(hand.load->point.y == 0.08);
  CHECK(hand.load->torque == 0.1);
  CHECK(hand.squeeze.grasping_force == 12.0);
  CHECK_FALSE(hand.squeeze.squeeze.has_value());
  CHECK(hand.friction_used == 0.9);
  REQUIRE(hand.fingers.size() == 2);
  const HandFinger& left = hand.fingers[0];
  CHECK(left.finger.name == "left");
  CHECK(left.finger.base.x == -0.03);
  CHECK_THAT(left.finger.direction, WithinRel(0.5 * std::numbers::pi, 1e-15));
  CHECK_THAT(left.finger.angles[1], WithinRel(-0.25 * std::numbers::pi, 1e-15));
  CHECK_THAT(left.finger.pad.tilt, WithinRel(std::numbers::pi / 36.0, 1e-15));
  CHECK(left.finger.pad.side == Side::right);
  CHECK(left.finger.pad.height == 0.005);
  CHECK_FALSE(left.finger.pad.reversed);
  CHECK(left.breadth == 0.02);
  CHECK(left.friction == 0.6);
  CHECK(left.torque_limits == std::vector{0.5, 0.3});
  const auto& force = std::get<FingertipForce>(left.contact);
  CHECK(force.normal == 7.0);
  CHECK(force.centre == 0.002);
  CHECK_THAT(force.covariance.deviation(ContactValue::normal), WithinRel(0.1, 1e-15));
  CHECK(force.covariance(ContactValue::tangential, ContactValue::tangential) == 0.0);
  CHECK(left.half_width == 0.01);
  const HandFinger& right = hand.fingers[1];
  CHECK(right.friction == 0.4);
  CHECK(right.torque_limits.empty());
  CHECK(right.breadth == 1.0);
  CHECK(right.finger.pad.reversed);
  CHECK(std::get<ContactPlace>(right.contact).deviation == 1e-3);
}

TEST_CASE("contacts from files, and names by number", "[hand]") {
  const Hand hand = parsed_hand(
      "[[finger]]\nbase = [0, 0]\nlinks = [1.0]\nangles = [0.5]\n"
      "pad = { center = 0.5, side = \"left\" }\n"
      "contact = { scene = \"a/tip.toml\", readings = \"b.csv\", frame = 3 }\n"
      "[[finger]]\nbase = [1, 0]\nlinks = [1.0]\nangles = [0.5]\n"
      "pad = { center = 0.5, side = \"left\", half_width = 2.0 }\n"
      "contact = { tractions = \"t.csv\", pitch = 0.25 }\n"
      "[[finger]]\nbase = [2, 0]\nlinks = [1.0]\nangles = [0.5]\n"
      "[finger.pad]\ncenter = 0.5\nside = \"left\"\n[finger.contact]\nscene = \"tip.toml\"\n");
  CHECK(hand.fingers[1].finger.name == "finger 2");
  CHECK(hand.fingers[0].finger.angles[0] == 0.5);
  CHECK_FALSE(hand.fingers[0].half_width.has_value());
  CHECK(hand.fingers[0].with_pad(7.0).pad.half_width == 7.0);
  CHECK(hand.fingers[1].with_pad(7.0).pad.half_width == 2.0);
  const auto& tip = std::get<FingertipScene>(hand.fingers[0].contact);
  CHECK(tip.scene == "a/tip.toml");
  CHECK(tip.readings == "b.csv");
  CHECK(tip.frame == 3);
  const auto& file = std::get<TractionFile>(hand.fingers[1].contact);
  CHECK(file.file == "t.csv");
  CHECK(file.pitch == 0.25);
  CHECK(file.frame == 0);
  CHECK_FALSE(std::get<FingertipScene>(hand.fingers[2].contact).readings.has_value());
  CHECK_FALSE(hand.load.has_value());
}

TEST_CASE("what a hand cannot mean is refused at its place", "[hand]") {
  check("angles_in = \"degrees\"", "angles_in = \"degree\"", "2:13", "did you mean \"degrees\"?");
  check("angles_in = \"degrees\"", "units = \"mm\"", "2:9", "\"SI\"");
  check("[load]", "[laod]", "4:2", "did you mean load?");
  check("force = [0.5, -4.9]", "force = [0.5]", "5:9", "two numbers, X and Y (got 1)");
  check("force = [0.5, -4.9]", "force = [0.5, nan]", "5:15", "finite");
  check("point = [0.0, 0.08]\n", "", "4:1", "load.point is missing");
  check("torque = 0.1", "torque = \"0.1\"", "7:10", "must be a number");
  check("grasping_force = 12.0", "grasping_force = inf", "10:18", "finite");
  check("grasping_force = 12.0", "grasping_force = 12.0\nsqueeze = 1.0", "11:11", "exclude each");
  check("friction = 0.6", "friction = 0.0", "11:12", "must be > 0");
  check("friction = 0.6\n", "", "11:17", "needs the friction of finger 'left'");
  check("friction_used = 0.9", "friction_used = 1.1", "12:17", "must be > 0 and <= 1");
  check("name = \"left\"", "nmae = \"left\"", "15:1", "did you mean name?");
  check("name = \"right\"", "name = \"left\"", "25:8", "must not be another finger's");
  check("name = \"left\"", "name = \"\"", "15:8", "name on one line");
  check("base = [-0.03, 0.0]\n", "", "14:1", "finger.base is missing");
  check("links = [0.05, 0.04]", "links = [0.05, -0.04]", "18:16", "must be > 0");
  check("links = [0.05, 0.04]", "links = []", "18:9", "at least one length");
  check("angles = [30, -45]", "angles = [30]", "19:10",
        "one number for each link (2 links, got 1)");
  check("angles = [30, -45]", "angles = []", "19:10", "one number for each link");
  check("torque_limits = [0.5, 0.3]", "torque_limits = [0.5, 0.0]", "20:23", "must be > 0");
  check("torque_limits = [0.5, 0.3]", "torque_limits = [0.5, 0.3, 1]", "20:17", "each link");
  check("side = \"right\"", "side = \"rihgt\"", "21:66", "did you mean \"right\"?");
  check("half_width = 0.01, side = \"right\"", "half_width = 0.0, side = \"right\"", "21:53",
        "must be > 0");
  check("half_width = 0.01, side = \"right\"", "side = \"right\"", "21:7", "half_width is missing");
  check("breadth = 0.02", "breadth = -1", "21:95", "must be > 0");
  check("reversed = true", "reversed = 1", "31:69", "true or false");
  check("normal = 7.0", "normal = 0.0", "22:22", "contact.normal must be > 0");
  check("normal = 7.0", "normal = -7.0", "22:22", "a finger pushes");
  check("center = 0.002", "center = 0.0101", "22:54", "must lie on the fingertip");
  check("tangential = 1.0, ", "", "22:11", "tangential is missing");
  check("normal_deviation = 0.1", "normal_deviation = -0.1", "22:80", "must be >= 0");
  check("normal = 7.0, ", "", "22:26", "has no place without contact.normal");
  check("normal = 7.0", "scene = \"tip.toml\", normal = 7.0", "22:42", "beside contact.scene");
  check("normal = 7.0", "tractions = \"t.csv\"", "22:11", "pitch is missing");
  check("normal = 7.0", "frame = 2, normal = 7.0", "22:21", "without a file");
  check("contact = { center = 0.0", "contact = { scene = \"\"", "32:21", "must name a file");
  check("contact = { center = 0.0, center_deviation = 1e-3 }",
        "contact = { scene = \"x.toml\", frame = 2 }", "32:39", "without readings");
  check("contact = { center = 0.0, center_deviation = 1e-3 }",
        "contact = { scene = \"x.toml\", readings = \"r.csv\", frame = -1 }", "32:59", ">= 0");
}

TEST_CASE("a straight finger is named where its angles stand", "[hand]") {
  // The right pad's surface is on its link's axis: an angle of 0 or 180 degrees is straight.
  check("angles = [-30, 45]", "angles = [-30, 0]", "29:10", "straight");
  check("angles = [-30, 45]", "angles = [-30, 180]", "29:10", "bend finger 'right'");
}

TEST_CASE("a grasping force is for two fingers, a squeeze for more", "[hand]") {
  const std::string third =
      "[[finger]]\nname = \"third\"\nbase = [0, 0]\nlinks = [1.0]\nangles = [0.0]\n"
      "pad = { center = 0.5, side = \"left\", half_width = 0.1 }\ncontact = { center = 0.0 }\n";
  CHECK_THROWS_WITH(
      parsed_hand(good_hand + third),
      ContainsSubstring("is defined for two fingers") && ContainsSubstring("give squeeze instead"));
  CHECK_THROWS_WITH(parsed_hand("[grasp]\nsqueeze = 1.0\n" + third),
                    ContainsSubstring("two fingers"));
}

TEST_CASE("all mistakes of a hand are told at once", "[hand]") {
  std::string bad = good_hand;
  bad.replace(bad.find("-4.9"), 4, "nan ");
  bad.replace(bad.find("links ="), 7, "lnks  =");
  bad.replace(bad.find("normal = 7.0"), 12, "normal = -7 ");
  try {
    (void)parsed_hand(bad);
    FAIL("the hand was read");
  } catch (const InputError& error) {
    CHECK(error.diagnostics().size() == 3);
  }
}

TEST_CASE("a file that is no hand says so in a hand's words", "[hand]") {
  CHECK_THROWS_WITH(parsed_hand(""), ContainsSubstring("the hand is empty") &&
                                         ContainsSubstring("the smallest hand"));
  CHECK_THROWS_WITH(parsed_hand("x = 1"),
                    ContainsSubstring("a hand has") && ContainsSubstring("[finger] is missing"));
  CHECK_THROWS_WITH(parsed_hand("[[finger]\n"), ContainsSubstring("not valid TOML"));
  CHECK_THROWS_WITH(read_hand("no-such-hand.toml"), ContainsSubstring("no such file"));
}

TEST_CASE("damaged hands, in the plane or in space, are read or refused, never worse",
          "[hand][fuzz]") {
  std::ifstream in{SCENES "/hands/box.toml"};
  const std::string box{std::istreambuf_iterator<char>(in), {}};
  for (const std::string& good : {good_hand, box.substr(box.find("title"))}) {
    std::mt19937 random{1};
    int read = 0;
    for (int trial = 0; trial < 2500; ++trial) {
      std::string toml = good;
      for (int change = 0; change <= trial % 3; ++change) {
        const std::size_t at = random() % toml.size();
        if (trial % 2 == 0)
          toml.erase(at, 1 + random() % 8);
        else
          toml[at] = static_cast<char>(random() % 128);
      }
      try {
        const AnyHand any = parse_any_hand(toml, "folder/hand.toml", {.allow_outside = true});
        ++read;
        if (const auto* hand = std::get_if<Hand>(&any))
          for (const HandFinger& finger : hand->fingers)
            CHECK_NOTHROW(pose_of(finger.with_pad(1.0)));
        if (const auto* hand = std::get_if<SpaceHand>(&any))
          for (const SpaceHandFinger& one : hand->fingers)
            CHECK_NOTHROW(tactile_net::check(one.finger));
      } catch (const InputError& error) {
        const auto lines = static_cast<std::size_t>(std::count(toml.begin(), toml.end(), '\n')) + 1;
        for (const Diagnostic& diagnostic : error.diagnostics()) CHECK(diagnostic.line <= lines);
        CHECK_FALSE(error.diagnostics().empty());
      }
    }
    CHECK(read > 30);
  }
}

TEST_CASE("every shipped hand is read, has a title and begins with a comment", "[hand]") {
  int hands = 0;
  for (const auto& entry : std::filesystem::directory_iterator{SCENES "/hands"}) {
    if (entry.is_directory()) continue;  // fingertips
    ++hands;
    CAPTURE(entry.path());
    const auto title = [](const auto& hand) { return hand.title; };
    CHECK_FALSE(std::visit(title, read_any_hand(entry.path())).empty());
    std::ifstream in{entry.path()};
    std::string line;
    CHECK((std::getline(in, line) && line.starts_with("# ")));
  }
  CHECK(hands == 4);
  CHECK_FALSE(read_hand(SCENES "/recorded/hand.toml").title.empty());
}

TEST_CASE("a hand names files beside its own or below, and no others", "[hand]") {
  std::string name = (std::filesystem::temp_directory_path() / "tactile-net-hand-XXXXXX").string();
  REQUIRE(::mkdtemp(name.data()) != nullptr);
  const std::filesystem::path all = name;
  std::filesystem::create_directories(all / "hand/below");
  std::ofstream(all / "secret.toml") << "secret";
  std::filesystem::create_symlink(all / "secret.toml", all / "hand/link.toml");
  std::filesystem::create_symlink(all, all / "hand/up");
  const auto hand = [&](const std::string& contact) {
    return "[[finger]]\nbase = [0.0, 0.0]\nlinks = [1.0]\nangles = [0.5]\n"
           "pad = { center = 0.5, side = \"left\" }\ncontact = " +
           contact + "\n";
  };
  const auto read = [&](const std::string& contact, bool allowed = false) {
    return parse_hand(hand(contact), (all / "hand/hand.toml").string(), {.allow_outside = allowed});
  };
  for (const char* inside : {"tip.toml", "below/tip.toml", "./below/../tip.toml", "below/none/x"})
    CHECK_NOTHROW(read("{ scene = \"" + std::string(inside) + "\" }"));
  for (const char* outside :
       {"/etc/shadow", "../secret.toml", "below/../../secret.toml", "link.toml", "up/secret.toml",
        "/proc/self/environ", "/dev/zero", ".."}) {
    const std::string path(outside);
    CAPTURE(path);
    for (const std::string& contact :
         {"{ scene = \"" + path + "\" }", "{ tractions = \"" + path + "\", pitch = 1e-3 }",
          "{ scene = \"tip.toml\", readings = \"" + path + "\" }"}) {
      CHECK_THROWS_WITH(read(contact), ContainsSubstring("hand.toml:6:") &&
                                           ContainsSubstring("beside the hand's file"));
      CHECK_NOTHROW(read(contact, true));
    }
  }
  std::filesystem::remove_all(all);
}
