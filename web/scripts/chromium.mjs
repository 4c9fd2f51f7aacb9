// How Chromium is started: for the end-to-end tests and for pictures of the page.

/** Debian's Chromium, drawing in software, without the calls home that a closed network would refuse. CHROMIUM names another. */
export const chromiumOptions = {
  executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium',
  args: [
    '--no-sandbox',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--disable-quic',
    '--no-first-run',
  ],
};
