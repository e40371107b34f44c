// Extruded and revolved figures for the reference.
//
// Where a ray meets the curve of an edge, a polynomial in t is 0: of degree 2 for an extrusion, 4
// for a revolution. Between the roots of all edges' polynomials the ray is inside or outside, which
// the figure tells at one point.
#pragma once

#include "csgcore/primitive.hpp"
#include "kinds/local_solid.hpp"
#include "kinds/profile_figure.hpp"
#include "kinds/test_kind.hpp"

namespace csgcore::reference {

/// The surface of a side is that of its edge.
inline Surface edge_surface(size_t edge) { return Surface(edge + 2); }
inline size_t edge_of(Surface surface) { return size_t(surface) - 2; }

class ProfileSolid : public LocalSolid {
 public:
  explicit ProfileSolid(const Profile& profile) : figure_(profile) {}

  const Figure& figure() const { return figure_; }
  void add_spans(const NearRay& ray, Real thickness, std::vector<Span>& spans) const override;
  virtual bool contains(const LongVec3& point) const = 0;
  /// Returns the sides of TestKind.
  virtual std::vector<test_support::Side> sides(const LongVec3& point) const = 0;
  /// Returns a point inside that sees a surface point.
  Vec3 core(const Vec3& surface_point) const;

 protected:
  /// The solid's box.
  virtual LongVec3 min() const = 0;
  virtual LongVec3 max() const = 0;
  /// Returns the polynomial of an edge's curve along the ray.
  virtual Polynomial along(const NearRay& ray, const FigureEdge& edge) const = 0;
  /// Returns the surface that is next to a point.
  virtual Surface surface_at(const LongVec3& point) const = 0;

 private:
  const Figure figure_;
};

class ExtrusionSolid final : public ProfileSolid {
 public:
  explicit ExtrusionSolid(const Primitive& primitive);
  bool contains(const LongVec3& point) const override;
  std::vector<test_support::Side> sides(const LongVec3& point) const override;
  LongVec3 normal(const LongVec3& point, Surface surface) const override;
  Real scale_at(Real z) const { return bottom_scale_ + growth_ * (z - z_min_); }

 protected:
  LongVec3 min() const override;
  LongVec3 max() const override;
  Polynomial along(const NearRay& ray, const FigureEdge& edge) const override;
  Surface surface_at(const LongVec3& point) const override;

 private:
  const Real z_min_, z_max_, bottom_scale_, top_scale_, growth_;
};

class RevolutionSolid final : public ProfileSolid {
 public:
  explicit RevolutionSolid(const Primitive& primitive) : ProfileSolid(*primitive.profile()) {}
  bool contains(const LongVec3& point) const override;
  std::vector<test_support::Side> sides(const LongVec3& point) const override;
  LongVec3 normal(const LongVec3& point, Surface surface) const override;

 protected:
  LongVec3 min() const override;
  LongVec3 max() const override;
  Polynomial along(const NearRay& ray, const FigureEdge& edge) const override;
  Surface surface_at(const LongVec3& point) const override;
};

}  // namespace csgcore::reference
