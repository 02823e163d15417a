// A writer of MCAP files, the container of the robotics field (https://mcap.dev/spec), which Foxglove and Rerun open.
//
// Uncompressed chunks with their message indexes, then the summary: schemas, channels, statistics, chunk and metadata
// indexes, offsets. Room for the summary is kept free. If the disk is full, the part of the last chunk that still fits
// is written, and the file is ended like any other. A file that was not ended holds whole chunks, perhaps a part of
// one, and no summary; readers that read it from the front find all chunks. Numbers are little endian, like those of
// the machines on which this runs.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace groundstate {

/// An MCAP file that is being written. One thread; allocates.
class McapFile {
    static_assert(std::endian::native == std::endian::little);

  public:
    using Map = std::vector<std::pair<std::string, std::string>>;

    /// Creates the file. `error` says what failed.
    explicit McapFile(const std::string& path) : file_{open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)} {
        if (file_ < 0) {
            error_ = errno;
        }
        put(magic);
        Record header{*this, 0x01};
        text(header.content, "");
        text(header.content, "groundstate");
    }

    /// Whether a file of that path can be opened: 0, or the system's number of the obstacle. An empty path is fine.
    static int probe(const std::string& path) noexcept {
        const int file = path.empty() ? -1 : open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
        const int error = path.empty() || file >= 0 ? 0 : errno;
        if (file >= 0) {
            close(file);
        }
        return error;
    }

    McapFile(const McapFile&) = delete;
    McapFile& operator=(const McapFile&) = delete;
    ~McapFile() {
        if (file_ >= 0) {
            close(file_);
        }
    }

    /// The system's number of the first error, or 0. After an error no message is written any more.
    int error() const noexcept { return error_ != 0 ? error_ : full_; }

    /// A schema; its number.
    std::uint16_t schema(std::string_view name, std::string_view encoding, std::string_view data) {
        const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
        std::string content;
        number(content, id);
        text(content, name);
        text(content, encoding);
        text(content, data);
        record(0x03, content);
        schemas_.push_back(std::move(content));
        return id;
    }

    /// A channel of messages; its number.
    std::uint16_t channel(std::uint16_t schema, std::string_view topic, std::string_view encoding) {
        const auto id = static_cast<std::uint16_t>(channels_.size());
        std::string content;
        number(content, id);
        number(content, schema);
        text(content, topic);
        text(content, encoding);
        number(content, std::uint32_t{0});
        record(0x04, content);
        channels_.push_back(std::move(content));
        return id;
    }

    /// A record of names and values.
    void metadata(std::string_view name, const Map& values) {
        flush();
        std::string content;
        text(content, name);
        std::string map;
        for (const auto& [key, value] : values) {
            text(map, key);
            text(map, value);
        }
        text(content, map);
        std::string index;
        number(index, offset_);
        number(index, std::uint64_t{content.size() + 9});
        text(index, name);
        record(0x0c, content);
        metadata_.push_back(std::move(index));
    }

    /// A message. It is in the file after the next `flush`, or when its chunk is full; if the disk is full, it never
    /// is.
    void message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time_ns, std::string_view data) {
        if (error() != 0) {
            return;
        }
        if (chunk_.empty()) {
            first_ns_ = last_ns_ = time_ns;
        }
        first_ns_ = std::min(first_ns_, time_ns);
        last_ns_ = std::max(last_ns_, time_ns);
        std::string& index = indexes_[channel];
        number(index, time_ns);
        number(index, std::uint64_t{chunk_.size()});
        number(chunk_, std::uint8_t{0x05});
        number(chunk_, std::uint64_t{22 + data.size()});
        number(chunk_, channel);
        number(chunk_, sequence);
        number(chunk_, time_ns);
        number(chunk_, time_ns);
        chunk_ += data;
        ++counts_[channel];
        if (chunk_.size() >= chunk_size) {
            flush();
        }
    }

    /// Says that all messages before an instant have been written. A record of our own, as the format allows them from
    /// 0x80 on; other readers pass over it.
    void horizon(std::int64_t time_ns) {
        flush();
        if (error() != 0) {
            return;
        }
        std::string content;
        number(content, time_ns);
        record(0x80, content);
    }

    /// Writes the messages so far as a chunk.
    void flush() {
        fit();
        if (chunk_.empty()) {
            return;
        }
        const std::uint64_t start = offset_;
        {
            Record chunk{*this, 0x06};
            number(chunk.content, first_ns_);
            number(chunk.content, last_ns_);
            number(chunk.content, std::uint64_t{chunk_.size()});
            number(chunk.content, ~checksum(no_bytes, chunk_));
            text(chunk.content, "");
            number(chunk.content, std::uint64_t{chunk_.size()});
            chunk.content += chunk_;
        }
        const std::uint64_t end = offset_;
        std::string offsets;
        for (const auto& [channel, index] : indexes_) {
            number(offsets, channel);
            number(offsets, offset_);
            Record record{*this, 0x07};
            number(record.content, channel);
            text(record.content, index);
        }
        std::string content;
        number(content, first_ns_);
        number(content, last_ns_);
        number(content, start);
        number(content, end - start);
        text(content, offsets);
        number(content, offset_ - end);
        text(content, "");
        number(content, std::uint64_t{chunk_.size()});
        number(content, std::uint64_t{chunk_.size()});
        chunks_.push_back(std::move(content));
        begin_ns_ = chunks_.size() == 1 ? first_ns_ : std::min(begin_ns_, first_ns_);
        end_ns_ = std::max(end_ns_, last_ns_);
        chunk_.clear();
        indexes_.clear();
    }

    /// Writes the summary and the end of the file.
    void finish() {
        flush();
        std::string end;
        number(end, ~sum_);
        record(0x0f, end);
        const std::uint64_t summary = offset_;
        std::string offsets;
        group(offsets, 0x03, schemas_);
        group(offsets, 0x04, channels_);
        group(offsets, 0x0b, {statistics()});
        group(offsets, 0x08, chunks_);
        group(offsets, 0x0d, metadata_);
        const std::uint64_t offset_start = offset_;
        put(offsets);
        {
            Record footer{*this, 0x02};
            number(footer.content, summary);
            number(footer.content, offset_start);
            number(footer.content, std::uint32_t{0});
        }
        put(magic);
        // Gives back the room kept free. If that fails, the file is just as good.
        if (error_ == 0 && kept_ > offset_) {
            static_cast<void>(!ftruncate(file_, static_cast<off_t>(offset_)));
        }
    }

  private:
    static constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
    static constexpr std::size_t chunk_size = 256 * 1024;

    // Written when it goes out of scope.
    struct Record {
        Record(McapFile& to, std::uint8_t code) : file{to}, opcode{code} {}
        Record(const Record&) = delete;
        Record& operator=(const Record&) = delete;
        ~Record() { file.record(opcode, content); }
        McapFile& file;
        std::uint8_t opcode;
        std::string content{};
    };

    template <class N>
    static void number(std::string& to, N value) {
        to.append(reinterpret_cast<const char*>(&value), sizeof value);
    }

    static void text(std::string& to, std::string_view value) {
        number(to, static_cast<std::uint32_t>(value.size()));
        to += value;
    }

    static std::string framed(std::uint8_t opcode, std::string_view content) {
        std::string head;
        number(head, opcode);
        number(head, std::uint64_t{content.size()});
        return head.append(content);
    }

    // Keeps the part of the chunk that has room beside the summary. If that is less than all, the disk is full, and the
    // log ends.
    void fit() {
        while (!chunk_.empty() && !keep_free(chunk_.size() + around_chunk() + summary_size())) {
            full_ = errno;
            cut(chunk_.size() / 2);
        }
    }

    // Room on the disk for this many more bytes; false: there is none. If the file system promises nothing, it is seen
    // when they are written.
    bool keep_free(std::uint64_t bytes) noexcept {
        constexpr std::uint64_t ahead = 1024 * 1024;
        if (error_ != 0) {
            return true;
        }
        // How much the process may write; the file system ignores that when it keeps room.
        rlimit limit{};
        if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && offset_ + bytes > limit.rlim_cur) {
            errno = EFBIG;
            return false;
        }
        if (offset_ + bytes <= kept_) {
            return true;
        }
        for (const std::uint64_t wanted : {bytes + ahead, bytes}) {
            int failed = 0;
            do {
                failed = fallocate(file_, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset_), static_cast<off_t>(wanted));
            } while (failed != 0 && errno == EINTR);
            if (failed == 0) {
                kept_ = offset_ + wanted;
                return true;
            }
        }
        return errno != ENOSPC && errno != EDQUOT && errno != EFBIG;
    }

    // The bytes around the messages of the chunk: its head, and its indexes.
    std::uint64_t around_chunk() const noexcept {
        std::uint64_t size = 64;
        for (const auto& [channel, index] : indexes_) {
            size += 16 + index.size();
        }
        return size;
    }

    // How many bytes follow the last chunk, at most.
    std::uint64_t summary_size() const noexcept {
        constexpr std::uint64_t records_at_the_end = 8192;
        std::uint64_t size = records_at_the_end + 128 + 10 * indexes_.size();
        for (const auto* records : {&schemas_, &channels_, &chunks_, &metadata_}) {
            for (const std::string& content : *records) {
                size += content.size() + 9;
            }
        }
        return size;
    }

    // Keeps the first messages of the chunk, as many as fit into this many bytes.
    void cut(std::size_t most) {
        indexes_.clear();
        std::size_t end = 0;
        bool is_left = true;
        for (std::size_t at = 0; at < chunk_.size();) {
            const std::size_t next = at + 9 + number_at<std::size_t>(at + 1);
            const auto channel = number_at<std::uint16_t>(at + 9);
            const auto time_ns = number_at<std::uint64_t>(at + 15);
            is_left = is_left && next <= most;
            if (is_left) {
                first_ns_ = at == 0 ? time_ns : std::min(first_ns_, time_ns);
                last_ns_ = at == 0 ? time_ns : std::max(last_ns_, time_ns);
                number(indexes_[channel], time_ns);
                number(indexes_[channel], std::uint64_t{at});
                end = next;
            } else {
                --counts_[channel];
            }
            at = next;
        }
        chunk_.resize(end);
    }

    template <class N>
    N number_at(std::size_t place) const noexcept {
        N value{};
        std::memcpy(&value, chunk_.data() + place, sizeof value);
        return value;
    }

    void record(std::uint8_t opcode, std::string_view content) { put(framed(opcode, content)); }

    void group(std::string& offsets, std::uint8_t opcode, const std::vector<std::string>& records) {
        if (records.empty()) {
            return;
        }
        const std::uint64_t start = offset_;
        for (const std::string& content : records) {
            record(opcode, content);
        }
        std::string content;
        number(content, opcode);
        number(content, start);
        number(content, offset_ - start);
        offsets += framed(0x0e, content);
    }

    std::string statistics() const {
        std::string counts;
        std::uint64_t messages = 0;
        for (const auto& [channel, count] : counts_) {
            number(counts, channel);
            number(counts, count);
            messages += count;
        }
        std::string content;
        number(content, messages);
        number(content, static_cast<std::uint16_t>(schemas_.size()));
        number(content, static_cast<std::uint32_t>(channels_.size()));
        number(content, std::uint32_t{0});
        number(content, static_cast<std::uint32_t>(metadata_.size()));
        number(content, static_cast<std::uint32_t>(chunks_.size()));
        number(content, begin_ns_);
        number(content, end_ns_);
        text(content, counts);
        return content;
    }

    void put(std::string_view bytes) {
        sum_ = checksum(sum_, bytes);
        while (error_ == 0 && !bytes.empty()) {
            const ssize_t written = write(file_, bytes.data(), bytes.size());
            if (written < 0) {
                error_ = errno == EINTR ? 0 : errno;
            } else {
                offset_ += static_cast<std::uint64_t>(written);
                bytes.remove_prefix(static_cast<std::size_t>(written));
            }
        }
    }

    static constexpr std::uint32_t no_bytes = 0xffffffff;

    // The checksum of these bytes after those of `sum`; the format stores the complement.
    static std::uint32_t checksum(std::uint32_t sum, std::string_view bytes) noexcept {
        static constexpr auto table = [] {
            std::array<std::uint32_t, 256> entries{};
            for (std::uint32_t i = 0; i < 256; ++i) {
                std::uint32_t entry = i;
                for (int bit = 0; bit < 8; ++bit) {
                    entry = (entry >> 1) ^ ((entry & 1) != 0 ? 0xedb88320U : 0U);
                }
                entries[i] = entry;
            }
            return entries;
        }();
        for (const char byte : bytes) {
            sum = table[(sum ^ static_cast<std::uint8_t>(byte)) & 0xff] ^ (sum >> 8);
        }
        return sum;
    }

    std::uint32_t sum_ = no_bytes;  ///< of all that was written
    int file_;
    int error_ = 0;           ///< what a writing met
    int full_ = 0;            ///< why there is no more room for messages
    std::uint64_t kept_ = 0;  ///< up to where there is room on the disk
    std::uint64_t offset_ = 0;
    std::vector<std::string> schemas_{};
    std::vector<std::string> channels_{};
    std::vector<std::string> chunks_{};
    std::vector<std::string> metadata_{};
    std::map<std::uint16_t, std::uint64_t> counts_{};
    std::map<std::uint16_t, std::string> indexes_{};
    std::string chunk_{};
    std::uint64_t first_ns_ = 0;
    std::uint64_t last_ns_ = 0;
    std::uint64_t begin_ns_ = 0;
    std::uint64_t end_ns_ = 0;
};

}  // namespace groundstate
