// The body of sim/base/number/dual.h and sim/base/number/dual-inl.h: one source, included into the plain
// namespace and into the namespace of every instruction set (a function may not be inlined across instruction
// sets). No include guard.

/// N numbers of type V that are added and scaled together: the tangents of a dual number.
template <class V, int N>
struct Tangents {
  V t[N];
  VEGARD_INLINE Tangents operator+(const Tangents& o) const {
    Tangents r;
    for (int i = 0; i < N; ++i) r.t[i] = t[i] + o.t[i];
    return r;
  }
  VEGARD_INLINE Tangents operator-(const Tangents& o) const {
    Tangents r;
    for (int i = 0; i < N; ++i) r.t[i] = t[i] - o.t[i];
    return r;
  }
  VEGARD_INLINE Tangents operator*(V s) const {
    Tangents r;
    for (int i = 0; i < N; ++i) r.t[i] = t[i] * s;
    return r;
  }
  static VEGARD_INLINE Tangents zero() {
    Tangents r;
    for (int i = 0; i < N; ++i) r.t[i] = V(0);
    return r;
  }
};

/// A value of type V with its tangents D, a type with addition and multiplication by V. Arithmetic follows
/// the chain rule: a function that is a template of its number type returns exact derivatives by the same
/// code that renders.
template <class V, class D>
struct Dual {
  V v;
  D d;
  Dual() = default;
  VEGARD_INLINE Dual(V value)
      : v(value), d(D::zero()) {}  // NOLINT: a constant is a dual number without tangents
  VEGARD_INLINE Dual(V value, const D& tangents) : v(value), d(tangents) {}
};

template <class V, class D>
VEGARD_INLINE Dual<V, D> operator+(const Dual<V, D>& a, const Dual<V, D>& b) {
  return {a.v + b.v, a.d + b.d};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator+(const Dual<V, D>& a, V b) {
  return {a.v + b, a.d};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator+(V a, const Dual<V, D>& b) {
  return {a + b.v, b.d};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator-(const Dual<V, D>& a, const Dual<V, D>& b) {
  return {a.v - b.v, a.d - b.d};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator-(const Dual<V, D>& a, V b) {
  return {a.v - b, a.d};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator-(V a, const Dual<V, D>& b) {
  return {a - b.v, b.d * V(-1)};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator-(const Dual<V, D>& a) {
  return {V(0) - a.v, a.d * V(-1)};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator*(const Dual<V, D>& a, const Dual<V, D>& b) {
  return {a.v * b.v, a.d * b.v + b.d * a.v};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator*(const Dual<V, D>& a, V b) {
  return {a.v * b, a.d * b};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator*(V a, const Dual<V, D>& b) {
  return {a * b.v, b.d * a};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator/(const Dual<V, D>& a, const Dual<V, D>& b) {
  const V inverse = V(1) / b.v;
  const V quotient = a.v / b.v;
  return {quotient, (a.d - b.d * quotient) * inverse};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator/(V a, const Dual<V, D>& b) {
  const V inverse = V(1) / b.v;
  const V quotient = a / b.v;
  return {quotient, b.d * (V(0) - quotient * inverse)};
}
template <class V, class D>
VEGARD_INLINE Dual<V, D> operator/(const Dual<V, D>& a, V b) {
  return a * (V(1) / b);
}

template <class V, class D>
VEGARD_INLINE Dual<V, D> square_root(const Dual<V, D>& a) {
  const V root = square_root(a.v);
  return {root, a.d * (V(0.5) / root)};
}

/// Returns the value without its tangents.
template <class V, class D>
VEGARD_INLINE V value_of(const Dual<V, D>& a) {
  return a.v;
}
