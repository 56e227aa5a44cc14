declare module 'first-picture' {
  /** A `Motion` as text (shipped.ts), made by build/shipped.ts. */
  const text: string;
  export default text;
}
