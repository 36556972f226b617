// The table of device features: name, who needs it, what is done without it.
#include "gpu/device_features.h"

#include <algorithm>

#include "base/error.h"

namespace radiata::gpu {
namespace {

bool hasExtensions(const Abilities& abilities, const FeatureRow& row) {
    return std::ranges::all_of(row.extensions, [&](const char* name) { return abilities.extensions.contains(name); });
}

bool computesInSubgroups(const Abilities& a, vk::SubgroupFeatureFlags operations) {
    return (a.v11.subgroupSupportedOperations & operations) == operations &&
           (a.v11.subgroupSupportedStages & vk::ShaderStageFlagBits::eCompute);
}

const char* const kAddressUser = "all shaders: buffers are reached by address, so no storage range limits their size";

const std::vector<FeatureRow> kTable = {
    {"vulkan_1_3",
     {},
     "everything",
     nullptr,
     {},
     [](const Abilities& a) { return a.properties.apiVersion >= VK_API_VERSION_1_3; },
     [](FeatureChain&) {}},
    {"buffer_device_address",
     {},
     kAddressUser,
     nullptr,
     {},
     [](const Abilities& a) { return a.features.v12.bufferDeviceAddress == VK_TRUE; },
     [](FeatureChain& f) { f.v12.bufferDeviceAddress = VK_TRUE; }},
    {"scalar_block_layout",
     {},
     "structs shared by C++ and shaders",
     nullptr,
     {},
     [](const Abilities& a) { return a.features.v12.scalarBlockLayout == VK_TRUE; },
     [](FeatureChain& f) { f.v12.scalarBlockLayout = VK_TRUE; }},
    {"shader_int64",
     {},
     "addresses and 64-bit keys in shaders",
     nullptr,
     {},
     [](const Abilities& a) { return a.features.core.features.shaderInt64 == VK_TRUE; },
     [](FeatureChain& f) { f.core.features.shaderInt64 = VK_TRUE; }},
    {"timestamps",
     {},
     "the times that travel with a frame",
     nullptr,
     {},
     [](const Abilities& a) { return a.queue_family.has_value() && a.properties.limits.timestampPeriod > 0; },
     [](FeatureChain&) {}},
    {"synchronization2",
     {},
     "barriers between passes",
     nullptr,
     {},
     [](const Abilities& a) { return a.features.v13.synchronization2 == VK_TRUE; },
     [](FeatureChain& f) { f.v13.synchronization2 = VK_TRUE; }},
    {"timeline_semaphore",
     {},
     "waiting for submitted work",
     nullptr,
     {},
     [](const Abilities& a) { return a.features.v12.timelineSemaphore == VK_TRUE; },
     [](FeatureChain& f) { f.v12.timelineSemaphore = VK_TRUE; }},
    {"maintenance4",
     {},
     "workgroup sizes as specialisation constants",
     nullptr,
     {},
     [](const Abilities& a) { return a.features.v13.maintenance4 == VK_TRUE; },
     [](FeatureChain& f) { f.v13.maintenance4 = VK_TRUE; }},
    {"subgroup_arithmetic",
     {},
     "sums and minima within a workgroup",
     nullptr,
     {},
     [](const Abilities& a) { return computesInSubgroups(a, vk::SubgroupFeatureFlagBits::eArithmetic); },
     [](FeatureChain&) {}},
    {"subgroup_ballot",
     Feature::kSubgroupBallot,
     "compaction of lists",
     nullptr,
     {},
     [](const Abilities& a) { return computesInSubgroups(a, vk::SubgroupFeatureFlagBits::eBallot); },
     [](FeatureChain&) {}},
    {"full_subgroups",
     Feature::kFullSubgroups,
     "numbering invocations without a division",
     "the numbers that the driver makes",
     {},
     [](const Abilities& a) { return a.features.v13.computeFullSubgroups == VK_TRUE; },
     [](FeatureChain& f) { f.v13.computeFullSubgroups = VK_TRUE; }},
    {"ray_query",
     Feature::kRayQuery,
     "finding primitives in boxes",
     "a bounding volume hierarchy traversed in compute",
     {VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
      VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME},
     [](const Abilities& a) {
         return a.features.ray_query.rayQuery == VK_TRUE && a.features.acceleration.accelerationStructure == VK_TRUE;
     },
     [](FeatureChain& f) {
         f.ray_query.rayQuery = VK_TRUE;
         f.acceleration.accelerationStructure = VK_TRUE;
     }},
    {"int64_atomics",
     Feature::kInt64Atomics,
     "one compute pass that rasterises depth and primitive as one 64-bit word",
     "two passes with 32-bit atomics",
     {},
     [](const Abilities& a) { return a.features.v12.shaderBufferInt64Atomics == VK_TRUE; },
     [](FeatureChain& f) { f.v12.shaderBufferInt64Atomics = VK_TRUE; }},
    {"mesh_shader",
     Feature::kMeshShader,
     "rasterising decoded geometry without storing it",
     "decoding in compute, then indirect draws",
     {VK_EXT_MESH_SHADER_EXTENSION_NAME},
     [](const Abilities& a) {
         return a.features.mesh.meshShader == VK_TRUE && a.features.mesh.taskShader == VK_TRUE &&
                a.features.v13.maintenance4 == VK_TRUE;
     },
     [](FeatureChain& f) {
         f.mesh.meshShader = VK_TRUE;
         f.mesh.taskShader = VK_TRUE;
     }},
    {"raster",
     Feature::kRaster,
     "tessellated glyphs and rasterised boxes",
     "tracing of the same glyphs",
     {},
     [](const Abilities& a) {
         return a.draws && a.features.v13.dynamicRendering == VK_TRUE && a.features.v13.shaderTerminateInvocation == VK_TRUE &&
                a.features.core.features.fragmentStoresAndAtomics == VK_TRUE;
     },
     [](FeatureChain& f) {
         f.v13.dynamicRendering = VK_TRUE;
         f.v13.shaderTerminateInvocation = VK_TRUE;
         f.core.features.fragmentStoresAndAtomics = VK_TRUE;
     }},
    {"lines",
     Feature::kLines,
     "fibres drawn as lines by the device's rasteriser: pull, mesh, mesh-serial, geometry, tessellation, lines",
     "fibres drawn by a compute shader",
     {VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME},
     [](const Abilities& a) {
         return a.draws && a.features.lines.bresenhamLines == VK_TRUE && a.features.core.features.multiDrawIndirect == VK_TRUE;
     },
     [](FeatureChain& f) {
         f.lines.bresenhamLines = VK_TRUE;
         f.core.features.multiDrawIndirect = VK_TRUE;
     }},
    {"wide_lines",
     Feature::kWideLines,
     "such lines of more than one pixel",
     "refusing them",
     {},
     [](const Abilities& a) { return a.features.core.features.wideLines == VK_TRUE; },
     [](FeatureChain& f) { f.core.features.wideLines = VK_TRUE; }},
    {"geometry_shader",
     Feature::kGeometryShader,
     "the fiblet pipeline geometry",
     "refusing it",
     {},
     [](const Abilities& a) {
         return a.draws && a.features.core.features.geometryShader == VK_TRUE &&
                a.features.core.features.vertexPipelineStoresAndAtomics == VK_TRUE;
     },
     [](FeatureChain& f) {
         f.core.features.geometryShader = VK_TRUE;
         f.core.features.vertexPipelineStoresAndAtomics = VK_TRUE;
     }},
    {"tessellation_shader",
     Feature::kTessellationShader,
     "the fiblet pipeline tessellation",
     "refusing it",
     {},
     [](const Abilities& a) {
         return a.draws && a.features.core.features.tessellationShader == VK_TRUE &&
                a.features.core.features.vertexPipelineStoresAndAtomics == VK_TRUE;
     },
     [](FeatureChain& f) {
         f.core.features.tessellationShader = VK_TRUE;
         f.core.features.vertexPipelineStoresAndAtomics = VK_TRUE;
     }},
    {"mesh_subgroups",
     Feature::kMeshSubgroups,
     "prefixes over the invocations of a mesh shader",
     "shared memory",
     {VK_EXT_MESH_SHADER_EXTENSION_NAME},
     [](const Abilities& a) {
         return (a.v11.subgroupSupportedOperations & vk::SubgroupFeatureFlagBits::eShuffleRelative) &&
                (a.v11.subgroupSupportedStages & vk::ShaderStageFlagBits::eMeshEXT) && a.v11.subgroupSize >= 4;
     },
     [](FeatureChain&) {}},
    {"shader_float64",
     Feature::kFloat64,
     "the intersection method polynomial-double",
     "refusing that method; polynomial does the same in single precision",
     {},
     [](const Abilities& a) { return a.features.core.features.shaderFloat64 == VK_TRUE; },
     [](FeatureChain& f) { f.core.features.shaderFloat64 = VK_TRUE; }},
    {"memory_budget",
     Feature::kMemoryBudget,
     "refusing what would not fit beside other programs",
     "the heap's size as the only limit",
     {VK_EXT_MEMORY_BUDGET_EXTENSION_NAME},
     [](const Abilities&) { return true; },
     [](FeatureChain&) {}},
};

}  // namespace

std::span<const FeatureRow> featureTable() { return kTable; }

void FeatureChain::link(const std::set<std::string>& extensions) {
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
    void** end = &v13.pNext;
    auto append = [&](const char* extension, auto& structure) {
        structure.pNext = nullptr;
        if (!extensions.contains(extension)) return;
        *end = &structure;
        end = &structure.pNext;
    };
    *end = nullptr;
    append(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, acceleration);
    append(VK_KHR_RAY_QUERY_EXTENSION_NAME, ray_query);
    append(VK_EXT_MESH_SHADER_EXTENSION_NAME, mesh);
    append(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME, lines);
}

Abilities::Abilities(const vk::raii::PhysicalDevice& physical) : properties(physical.getProperties()) {
    const std::vector<vk::QueueFamilyProperties> families = physical.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size() && !draws; ++i) {
        if (!(families[i].queueFlags & vk::QueueFlagBits::eCompute) || families[i].timestampValidBits == 0) continue;
        draws = static_cast<bool>(families[i].queueFlags & vk::QueueFlagBits::eGraphics);
        if (draws || !queue_family) queue_family = i;
    }
    if (properties.apiVersion < VK_API_VERSION_1_3) return;
    for (const vk::ExtensionProperties& extension : physical.enumerateDeviceExtensionProperties()) {
        extensions.insert(extension.extensionName);
    }
    v11 = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties>()
              .get<vk::PhysicalDeviceVulkan11Properties>();
    v11.pNext = nullptr;
    features.link(extensions);
    physical.getDispatcher()->vkGetPhysicalDeviceFeatures2(static_cast<VkPhysicalDevice>(*physical),
                                                           reinterpret_cast<VkPhysicalDeviceFeatures2*>(&features.core));
}

std::string missingFeatures(const Abilities& abilities) {
    std::string missing;
    for (const FeatureRow& row : kTable) {
        if (row.fallback != nullptr || (row.present(abilities) && hasExtensions(abilities, row))) continue;
        missing += (missing.empty() ? "" : ", ") + std::string(row.name) + " (needed by " + row.needed_by + ")";
    }
    return missing;
}

std::vector<const FeatureRow*> chosenFeatures(const Abilities& abilities, const std::vector<std::string>& without) {
    for (const std::string& name : without) {
        std::string known;
        bool found = false;
        for (const FeatureRow& row : kTable) {
            if (row.fallback == nullptr) continue;
            known += (known.empty() ? "" : ", ") + std::string(row.name);
            found = found || row.name == name;
        }
        if (!found) {
            throw Error(Code::kInvalidArgument, "no device feature '" + name + "' can be left off; these can: " + known);
        }
    }
    std::vector<const FeatureRow*> rows;
    for (const FeatureRow& row : kTable) {
        const bool left_off = std::ranges::find(without, row.name) != without.end();
        if (!left_off && hasExtensions(abilities, row) && row.present(abilities)) rows.push_back(&row);
    }
    return rows;
}

}  // namespace radiata::gpu
