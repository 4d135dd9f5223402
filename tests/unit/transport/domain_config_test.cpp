// Which configuration a domain gets by default, and that the shipped files say the same.
#include "service/transport/domain_config.h"

#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <optional>
#include <regex>

#include "service/transport/interfaces.h"
#include "service/transport/receive_buffer.h"

namespace bleedsim::transport {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// An environment variable with another value, for as long as it lives; without a value it is not set.
class Variable {
 public:
  Variable(const char* name, const std::optional<std::string>& value) : name_{name} {
    if (const char* old = std::getenv(name)) before_ = old;
    set(value);
  }
  ~Variable() { set(before_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    if (value) {
      setenv(name_, value->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }

  const char* name_;
  std::optional<std::string> before_;
};

class ChooseConfigTest : public testing::Test {
 protected:
  Variable uri_{"CYCLONEDDS_URI", {}};
  Variable tag_{"BLEEDSIM_DDS_TAG", {}};
};

TEST_F(ChooseConfigTest, IsTheOneForLoopbackUnlessAnInterfaceIsNamed) {
  for (const char* name : {"", "lo"}) {
    const auto config = chooseConfig({.interface = name});
    ASSERT_TRUE(config) << config.status().message();
    EXPECT_EQ(config->kind, ConfigKind::loopback);
    EXPECT_EQ(config->interface, "lo");
    EXPECT_THAT(describe(*config), AllOf(HasSubstr("loopback only"), HasSubstr("dds/loopback.xml"), Not(HasSubstr(", tag"))));
  }
}

TEST_F(ChooseConfigTest, IsTheNetworksForAnyOtherInterface) {
  for (const NetworkInterface& interface : listInterfaces()) {
    if (interface.loopback || !interface.up) continue;
    const auto config = chooseConfig({.interface = interface.name});
    ASSERT_TRUE(config) << config.status().message();
    EXPECT_EQ(config->kind, ConfigKind::network) << interface.name;
    EXPECT_THAT(describe(*config), AllOf(HasSubstr(interface.name), HasSubstr("dds/network.xml")));
    return;
  }
  GTEST_SKIP() << "this host has loopback only";
}

TEST_F(ChooseConfigTest, IsTheUsersWhenThereIsOne) {
  const Variable uri{"CYCLONEDDS_URI", "file:///etc/cyclone.xml"};
  const auto config = chooseConfig({.interface = "nosuch0"});
  ASSERT_TRUE(config);
  EXPECT_EQ(config->kind, ConfigKind::user);
  EXPECT_THAT(describe(*config), AllOf(HasSubstr("CYCLONEDDS_URI"), HasSubstr("file:///etc/cyclone.xml")));
}

TEST_F(ChooseConfigTest, AnEmptyUriIsNone) {
  const Variable uri{"CYCLONEDDS_URI", ""};
  EXPECT_EQ(chooseConfig({})->kind, ConfigKind::loopback);
}

TEST_F(ChooseConfigTest, TakesTheTagOfTheOptionsBeforeThatOfTheEnvironment) {
  const Variable tag{"BLEEDSIM_DDS_TAG", "around"};
  EXPECT_EQ(chooseConfig({})->tag, "around");
  EXPECT_EQ(chooseConfig({.tag = "given"})->tag, "given");
  EXPECT_THAT(describe(*chooseConfig({})), HasSubstr("tag 'around'"));
  const Variable bad{"BLEEDSIM_DDS_TAG", "</Tag>"};
  EXPECT_EQ(chooseConfig({}).status().code(), StatusCode::invalid_argument);
}

/// A configuration without what has no meaning: comments, the declaration, name spaces, blanks between elements.
std::string essence(std::string xml) {
  xml = std::regex_replace(xml, std::regex{"<!--[^]*?-->"}, "");
  xml = std::regex_replace(xml, std::regex{"<\\?[^]*?\\?>"}, "");
  xml = std::regex_replace(xml, std::regex{" xmlns=\"[^\"]*\""}, "");
  return std::regex_replace(xml, std::regex{">\\s+<|^\\s+|\\s+$"}, "><");
}

std::string shipped(const std::string& name) {
  std::ifstream file{DDS_CONFIG_DIR "/" + name};
  std::string xml = essence({std::istreambuf_iterator<char>{file}, {}});
  // A person reads 64 MiB.
  return std::regex_replace(xml, std::regex{"\"64MiB\""}, "\"" + std::to_string(kReceiveBufferBytes) + "B\"");
}

std::string builtIn(const DomainConfig& config) { return essence("\n" + configXml(config) + "\n"); }

TEST(ConfigXml, IsThatOfTheShippedFiles) {
  EXPECT_EQ(kReceiveBufferBytes, std::size_t{64} << 20);
  EXPECT_EQ(shipped("loopback.xml"), builtIn({.kind = ConfigKind::loopback, .interface = "lo"}));
  EXPECT_EQ(shipped("network.xml"), builtIn({.kind = ConfigKind::network, .interface = "eth0"}));
  EXPECT_NE(shipped("network.xml"), builtIn({.kind = ConfigKind::network, .interface = "eth1"})) << "the comparison sees values";
}

TEST(ConfigXml, UsesLargeDatagramsOnLoopbackOnly) {
  const std::string loopback = configXml({.kind = ConfigKind::loopback, .interface = "lo"});
  EXPECT_THAT(loopback, HasSubstr("<MaxMessageSize>65500B</MaxMessageSize>"));
  EXPECT_THAT(loopback, HasSubstr("<FragmentSize>65000B</FragmentSize>"));
  const std::string network = configXml({.kind = ConfigKind::network, .interface = "eth0", .tag = "lab"});
  EXPECT_THAT(network, HasSubstr("<MaxMessageSize>1460B</MaxMessageSize>"));
  EXPECT_THAT(network, Not(HasSubstr("FragmentSize")));
  EXPECT_THAT(network, HasSubstr("<Tag>lab</Tag>"));
}

TEST(ConfigXml, NeverDemandsAMinimumReceiveBuffer) {
  const std::string xml = configXml({.kind = ConfigKind::loopback, .interface = "lo"});
  EXPECT_THAT(xml, HasSubstr("<SocketReceiveBufferSize max=\"67108864B\"/>"));
  EXPECT_THAT(xml, Not(HasSubstr("min=")));
}

}  // namespace
}  // namespace bleedsim::transport
