// The log's file: what is in it when the disk is full.
#include "groundstate/mcap_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace groundstate {
namespace {

constexpr int message = 0x05, chunk = 0x06, metadata = 0x0c, statistics = 0x0b, footer = 0x02;

// The records of a file in their order, as opcode and content; those within chunks as well.
struct Records {
    explicit Records(const std::string& path) {
        std::ifstream file{path, std::ios::binary};
        const std::string all{std::istreambuf_iterator<char>{file}, {}};
        EXPECT_EQ(all.substr(all.size() - 8), all.substr(0, 8)) << "it begins and ends with the mark of the format";
        walk(all.substr(8, all.size() - 16));
    }

    void walk(std::string_view bytes) {
        while (bytes.size() >= 9) {
            std::uint64_t size = 0;
            std::memcpy(&size, bytes.data() + 1, sizeof size);
            ASSERT_LE(size, bytes.size() - 9) << "a record that ends beyond its end";
            const auto content = bytes.substr(9, size);
            ++count[static_cast<unsigned char>(bytes[0])];
            if (bytes[0] == chunk) {
                walk(content.substr(8 + 8 + 8 + 4 + 4 + 8));
            }
            if (bytes[0] == statistics) {
                std::memcpy(&told, content.data(), sizeof told);
            }
            bytes.remove_prefix(9 + size);
        }
        EXPECT_TRUE(bytes.empty());
    }

    std::map<int, std::uint64_t> count{};
    std::uint64_t told = 0;  ///< how many messages its statistics speak of
};

// Writes so many messages where a file may have so many bytes.
int write(const std::string& path, int messages, rlim_t most) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{most, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    McapFile file{path};
    const std::uint16_t topic = file.channel(file.schema("Event", "jsonschema", "{}"), "/task", "json");
    for (int i = 0; i < messages; ++i) {
        file.message(topic, static_cast<std::uint32_t>(i), static_cast<std::uint64_t>(i), std::string(100, 'x'));
    }
    file.metadata("end", {{"lost", "0"}});
    file.finish();
    setrlimit(RLIMIT_FSIZE, &before);
    return file.error();
}

TEST(McapFile, HoldsAllWhereThereIsRoom) {
    const std::string path = testing::TempDir() + "whole.mcap";
    EXPECT_EQ(write(path, 5000, RLIM_INFINITY), 0);
    Records records{path};
    EXPECT_EQ(records.count[message], 5000U);
    EXPECT_EQ(records.told, 5000U);
    std::remove(path.c_str());
}

TEST(McapFile, IsEndedAsAnyOtherWhenTheDiskIsFull) {
    const std::string path = testing::TempDir() + "full.mcap";
    for (const rlim_t most : {20'000U, 100'000U, 400'000U}) {
        EXPECT_EQ(write(path, 5000, most), EFBIG);
        Records records{path};
        EXPECT_GT(records.count[message], most / 400);
        EXPECT_LT(records.count[message], most / 131);
        EXPECT_EQ(records.told, records.count[message]);
        EXPECT_EQ(records.count[metadata], 1U);
        EXPECT_EQ(records.count[footer], 1U);
    }
    std::remove(path.c_str());
}

}  // namespace
}  // namespace groundstate
