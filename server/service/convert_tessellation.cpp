// Deformed spheres and their settings.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {

model::Tessellation fromProto(const v1::Tessellation& tessellation, const std::string& where) {
    checkEnum(tessellation.mesh(), v1::SphereMesh_IsValid, v1::SphereMesh_MAX, where + ".mesh");
    checkEnum(tessellation.normals(), v1::MeshNormals_IsValid, v1::MeshNormals_MAX, where + ".normals");
    model::Tessellation result;
    switch (tessellation.mesh()) {
        case v1::SPHERE_MESH_OCTAHEDRON:
            result.mesh = model::SphereMesh::kOctahedron;
            break;
        case v1::SPHERE_MESH_TETRAHEDRON:
            result.mesh = model::SphereMesh::kTetrahedron;
            break;
        case v1::SPHERE_MESH_LATITUDE_LONGITUDE:
            result.mesh = model::SphereMesh::kLatitudeLongitude;
            result.level = 20;
            break;
        default:
            break;
    }
    if (tessellation.has_level()) result.level = toInt(tessellation.level(), where + ".level");
    if (tessellation.normals() == v1::MESH_NORMALS_TRIANGLE) result.normals = model::MeshNormals::kTriangle;
    return result;
}

v1::Tessellation toProto(const model::Tessellation& tessellation) {
    v1::Tessellation message;
    switch (tessellation.mesh) {
        case model::SphereMesh::kIcosphere:
            message.set_mesh(v1::SPHERE_MESH_ICOSPHERE);
            break;
        case model::SphereMesh::kOctahedron:
            message.set_mesh(v1::SPHERE_MESH_OCTAHEDRON);
            break;
        case model::SphereMesh::kTetrahedron:
            message.set_mesh(v1::SPHERE_MESH_TETRAHEDRON);
            break;
        case model::SphereMesh::kLatitudeLongitude:
            message.set_mesh(v1::SPHERE_MESH_LATITUDE_LONGITUDE);
            break;
    }
    message.set_level(static_cast<std::uint32_t>(tessellation.level));
    const bool flat = tessellation.normals == model::MeshNormals::kTriangle;
    message.set_normals(flat ? v1::MESH_NORMALS_TRIANGLE : v1::MESH_NORMALS_ANALYTIC);
    return message;
}

}  // namespace radiata::service
