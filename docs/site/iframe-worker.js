/* Pages opened as files may start no workers. The search's worker runs in a hidden frame instead, and is sent the same messages. */
if (location.protocol === "file:")
  window.Worker = class extends EventTarget {
    constructor(url) {
      super()
      this.waiting = []
      this.frame = document.createElement("iframe")
      this.frame.hidden = true
      this.frame.srcdoc = "<body></body>"
      this.frame.onload = () => this.start(String(url))
      document.body.append(this.frame)
    }
    async start(url) {
      this.inside = this.frame.contentWindow
      this.inside.postMessage = data => this.dispatchEvent(new MessageEvent("message", { data }))
      this.inside.importScripts = async (...urls) => {
        for (const each of urls) await this.load(each)
      }
      await this.load(url)
      for (const data of this.waiting.splice(0)) this.send(data)
      this.waiting = null
    }
    load(src) {
      return new Promise((onload, onerror) => {
        const script = this.frame.contentDocument.createElement("script")
        this.frame.contentDocument.body.append(Object.assign(script, { src, onload, onerror }))
      })
    }
    postMessage(data) {
      if (this.waiting) this.waiting.push(data)
      else this.send(data)
    }
    send(data) {
      this.inside.dispatchEvent(new this.inside.MessageEvent("message", { data }))
    }
    terminate() {
      this.frame.remove()
    }
  }
