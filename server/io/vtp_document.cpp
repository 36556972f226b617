#include "io/vtp_document.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <map>
#include <optional>

#include <pugixml.hpp>

#include "base/error.h"
#include "io/byte_source.h"
#include "io/text.h"
#include "io/vtp_numbers.h"

namespace radiata::io {
namespace {

constexpr std::uint64_t kTextMax = std::uint64_t{1} << 32;
constexpr std::size_t kBlock = std::size_t{1} << 18, kTagMax = 8192;
// A tree takes up to twenty times the memory of its tags and attributes; no writer makes this many.
constexpr std::size_t kMarksMax = std::size_t{1} << 21;
constexpr std::string_view kAppendedTag = "<AppendedData";

std::optional<SampleType> typeNamed(const std::string& name) {
    static const std::map<std::string, SampleType> kTypes{
        {"Int8", SampleType::kInt8},       {"UInt8", SampleType::kUInt8},   {"Int16", SampleType::kInt16},
        {"UInt16", SampleType::kUInt16},   {"Int32", SampleType::kInt32},   {"UInt32", SampleType::kUInt32},
        {"Int64", SampleType::kInt64},     {"UInt64", SampleType::kUInt64}, {"Float32", SampleType::kFloat32},
        {"Float64", SampleType::kFloat64}, {"String", SampleType::kUInt8},
    };
    const auto found = kTypes.find(name);
    if (found == kTypes.end()) return std::nullopt;
    return found->second;
}

class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : source_(path, Packing::kPlain, 0) { document_.path = path; }

    VtpDocument read() {
        takeText();
        const pugi::xml_parse_result parsed =
            tree_.load_buffer_inplace(document_.xml.data(), document_.xml.size(),
                                      pugi::parse_escapes | pugi::parse_comments | pugi::parse_cdata, pugi::encoding_utf8);
        if (!parsed) {
            fail("is no well-formed XML: " + std::string(parsed.description()) + " at byte " + std::to_string(parsed.offset));
        }
        const pugi::xml_node root = tree_.child("VTKFile");
        if (!root) fail("has no element VTKFile");
        readRoot(root);
        const pugi::xml_node data = root.child("PolyData");
        if (!data) fail("has no element PolyData");
        for (const pugi::xml_node& piece : data.children("Piece")) document_.pieces.push_back(pieceOf(piece));
        if (document_.pieces.empty()) fail("has no element Piece");
        for (const pugi::xml_node& parent : {pugi::xml_node(tree_), root, data}) {
            for (const pugi::xml_node& node : parent.children()) {
                if (node.type() == pugi::node_comment) document_.space += std::string(node.value()) + " ";
            }
            readSpace(parent.child("FieldData"));
        }
        return std::move(document_);
    }

private:
    [[noreturn]] void fail(const std::string& what, Code code = Code::kCorrupt) const {
        throw Error(code, source_.name() + ": " + what);
    }

    /// Reads on until the text has `wanted` bytes or the file ends. \return false at the end
    bool fill(std::size_t wanted) {
        std::vector<char>& text = document_.xml;
        const std::size_t before = text.size();
        if (wanted > kTextMax) {
            fail("has more than 4 GiB before its appended data; files of this size are read with appended data only",
                 Code::kResourceExhausted);
        }
        text.resize(std::max(wanted, before));
        text.resize(before + source_.read(std::as_writable_bytes(std::span(text).subspan(before))));
        marks_ += static_cast<std::size_t>(std::count_if(text.begin() + static_cast<std::ptrdiff_t>(before), text.end(),
                                                         [](char c) { return c == '<' || c == '='; }));
        if (marks_ > kMarksMax) {
            fail("has more than " + std::to_string(kMarksMax) + " elements and attributes", Code::kResourceExhausted);
        }
        return text.size() > before;
    }

    /// All up to the appended data, which may be no XML at all; their element is closed here.
    void takeText() {
        std::vector<char>& text = document_.xml;
        std::size_t at = std::string_view::npos;
        for (std::size_t from = 0; at == std::string_view::npos;) {
            if (!fill(text.size() + kBlock)) return;
            at = std::string_view(text.data(), text.size()).find(kAppendedTag, from);
            from = text.size() - std::min(text.size(), kAppendedTag.size());
        }
        fill(at + kTagMax);
        const std::string_view all(text.data(), text.size());
        const std::size_t close = all.find('>', at);
        if (close == all.npos) fail("ends within the tag AppendedData");
        std::string_view end = "</VTKFile>";
        if (all[close - 1] != '/') {
            const std::size_t first = all.find_first_not_of(" \t\r\n", close + 1);
            if (first == all.npos || all[first] != '_') fail("has no underscore where its appended data should begin");
            document_.appended = first + 1;
            end = "</AppendedData></VTKFile>";
        }
        text.resize(close + 1);
        text.insert(text.end(), end.begin(), end.end());
    }

    void readRoot(const pugi::xml_node& root) {
        const std::string type = root.attribute("type").value();
        if (type != "PolyData") {
            fail("holds " + shown(type) + "; lines are read from PolyData only", Code::kUnsupported);
        }
        const std::string order = root.attribute("byte_order").as_string("LittleEndian");
        if (order != "LittleEndian" && order != "BigEndian") {
            fail("has the byte_order " + shown(order) + "; it must be LittleEndian or BigEndian");
        }
        document_.swapped = (order == "BigEndian") != (std::endian::native == std::endian::big);
        const std::string word = root.attribute("header_type").as_string("UInt32");
        if (word != "UInt32" && word != "UInt64") {
            fail("has the header_type " + shown(word) + "; UInt32 and UInt64 are read", Code::kUnsupported);
        }
        document_.word_bytes = word == "UInt64" ? 8 : 4;
        const std::string compressor = root.attribute("compressor").value();
        if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
            fail("is compressed by " + shown(compressor) + "; only vtkZLibDataCompressor and no compressor are read",
                 Code::kUnsupported);
        }
        document_.zlib = !compressor.empty();
        const std::string encoding = root.child("AppendedData").attribute("encoding").as_string("base64");
        if (encoding != "base64" && encoding != "raw") {
            fail("has appended data in the encoding " + shown(encoding) + "; base64 and raw are read", Code::kUnsupported);
        }
        document_.appended_base64 = encoding == "base64";
    }

    std::uint64_t whole(const pugi::xml_node& node, const char* attribute, bool needed) const {
        const std::string_view text = node.attribute(attribute).value();
        if (text.empty() && !needed) return 0;
        std::uint64_t value = 0;
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (failure != std::errc() || end != text.data() + text.size() || value >> 48 != 0) {
            fail(std::string(node.name()) + " " + shown(node.attribute("Name").value()) + " has the " + attribute + " " +
                 shown(text) + ", which is no usable count");
        }
        return value;
    }

    /// \return nothing if its numbers are of a type that is not read
    std::optional<VtpArray> arrayOf(const pugi::xml_node& node) const {
        VtpArray array;
        array.name = node.attribute("Name").value();
        const std::optional<SampleType> type = typeNamed(node.attribute("type").value());
        if (!type) return std::nullopt;
        array.type = *type;
        const std::uint64_t components = node.attribute("NumberOfComponents") ? whole(node, "NumberOfComponents", true) : 1;
        if (components == 0 || components > 4096) {
            fail("the array " + shown(array.name) + " has " + std::to_string(components) + " components; 1 to 4096 are read");
        }
        array.components = static_cast<int>(components);
        const std::string format = node.attribute("format").as_string("ascii");
        if (format == "appended") {
            array.place = VtpArray::Place::kAppended;
            array.offset = whole(node, "offset", true);
            if (document_.appended == 0) fail("the array " + shown(array.name) + " is appended, but there is no AppendedData");
        } else if (format == "ascii" || format == "binary") {
            array.place = format == "ascii" ? VtpArray::Place::kText : VtpArray::Place::kBase64;
            array.text = node.text().get();
        } else {
            fail("the array " + shown(array.name) + " has the format " + shown(format) +
                 "; ascii, binary and appended are read");
        }
        return array;
    }

    VtpArray needed(const pugi::xml_node& node, const std::string& what) const {
        if (!node) fail("has no " + what);
        std::optional<VtpArray> array = arrayOf(node);
        if (!array) fail("has " + what + " of the type " + shown(node.attribute("type").value()), Code::kUnsupported);
        array->name = what;
        return std::move(*array);
    }

    std::vector<VtpArray> columns(const pugi::xml_node& parent) {
        std::vector<VtpArray> found;
        for (const pugi::xml_node& node : parent.children("DataArray")) {
            std::optional<VtpArray> array = arrayOf(node);
            if (array && !array->name.empty()) {
                found.push_back(std::move(*array));
            } else {
                document_.remarks += "An array of the type " + shown(node.attribute("type").value()) + " called " +
                                     shown(node.attribute("Name").value()) + " is left out. ";
            }
        }
        return found;
    }

    VtpPiece pieceOf(const pugi::xml_node& node) {
        VtpPiece piece;
        piece.points = whole(node, "NumberOfPoints", true);
        piece.lines = whole(node, "NumberOfLines", false);
        piece.cells_ahead = whole(node, "NumberOfVerts", false);
        piece.cells =
            piece.cells_ahead + piece.lines + whole(node, "NumberOfStrips", false) + whole(node, "NumberOfPolys", false);
        if (piece.lines == 0) return piece;
        piece.coordinates = needed(node.child("Points").child("DataArray"), "points");
        if (piece.coordinates.components != 3) {
            fail("has points of " + std::to_string(piece.coordinates.components) + " components; they must have 3");
        }
        const pugi::xml_node lines = node.child("Lines");
        piece.ids = needed(lines.find_child_by_attribute("DataArray", "Name", "connectivity"), "connectivity of lines");
        piece.offsets = needed(lines.find_child_by_attribute("DataArray", "Name", "offsets"), "offsets of lines");
        for (const VtpArray* array : {&piece.ids, &piece.offsets}) {
            if (array->type == SampleType::kFloat32 || array->type == SampleType::kFloat64) {
                fail("has " + array->name + " that are no whole numbers");
            }
        }
        piece.point_data = columns(node.child("PointData"));
        piece.cell_data = columns(node.child("CellData"));
        return piece;
    }

    /// The field SPACE, a string such as LPS, as 3D Slicer writes it.
    void readSpace(const pugi::xml_node& fields) {
        constexpr std::uint64_t kSpaceLetters = 3;
        for (const pugi::xml_node& node : fields.children()) {
            const std::optional<VtpArray> array = arrayOf(node);
            if (!array || array->name != "SPACE" || array->type != SampleType::kUInt8) continue;
            VtpNumbers letters(document_, *array, std::nullopt);
            document_.space += "SPACE=";
            for (std::uint64_t i = 0; i < kSpaceLetters; ++i) {
                const std::int64_t letter = letters.readId();
                document_.space += letter > 32 && letter < 127 ? static_cast<char>(letter) : '?';
            }
            document_.space += " ";
        }
    }

    ByteSource source_;
    VtpDocument document_;
    pugi::xml_document tree_;
    std::size_t marks_ = 0;
};

}  // namespace

VtpDocument readVtpDocument(const std::filesystem::path& path) { return Reader(path).read(); }

}  // namespace radiata::io
